#include "src/scene/scene_builder.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr Choice<Response> kResponses[] = {{"bounce", Response::Bounce},
                                           {"remove", Response::Remove},
                                           {"remove-immediately", Response::RemoveImmediately},
                                           {"slide", Response::Slide},
                                           {"report", Response::Report}};

using GroupRule = SceneBuilder::GroupRule;
constexpr std::uint32_t kAny = GroupRule::kAny;

/// A group's index, or kAny.
std::optional<std::uint32_t> readGroup(SceneBuilder& builder, const TomlValue& value,
                                       const std::string& what) {
  const auto* name = std::get_if<std::string>(&value.data);
  if (name != nullptr && *name == "*") return kAny;
  return builder.findGroup(value, what);
}

/// The two groups that the rule is for. False when one of them is wrong.
bool readGroups(SceneBuilder& builder, const TableReader& reader, ContactRule& rule) {
  const TomlValue* between = reader.find("between");
  if (between == nullptr) {
    reader.require("between");
    return false;
  }
  const std::string what = reader.described("between");
  if (between->array() == nullptr || between->array()->size() != 2) {
    reportMismatch(*between, what, "an array of 2 group names", builder.errors);
    return false;
  }
  const auto first = readGroup(builder, (*between->array())[0], "value 1 of " + what);
  const auto second = readGroup(builder, (*between->array())[1], "value 2 of " + what);
  if (!first || !second) return false;
  rule.groupA = *first;
  rule.groupB = *second;
  return true;
}

/// The groups that "*" is not to stand for.
std::vector<std::uint32_t> readExceptions(SceneBuilder& builder, const TableReader& reader,
                                          const ContactRule& rule, bool groupsKnown) {
  std::vector<std::uint32_t> except;
  const TomlValue* value = reader.find("except");
  if (value == nullptr) return except;
  const std::string what = reader.described("except");
  if (value->array() == nullptr || value->array()->empty()) {
    reportMismatch(*value, what, "a list of group names", builder.errors);
    return except;
  }
  if (groupsKnown && rule.groupA != kAny && rule.groupB != kAny)
    reader.reject("except", "belongs to a 'between' with \"*\"");
  std::size_t number = 0;
  for (const TomlValue& element : *value->array()) {
    const auto group = builder.findGroup(element, fmt::format("value {} of {}", ++number, what));
    if (group) except.push_back(*group);
  }
  std::sort(except.begin(), except.end());
  except.erase(std::unique(except.begin(), except.end()), except.end());
  return except;
}

/// Only a bounce has a restitution, and only a bounce and a slide move anything: the other responses act on
/// every touching pair and leave its motion alone. Saying so (`separate = false`) is fine, asking for more is
/// not.
void rejectWhatTheResponseLacks(const TableReader& reader, const ContactRule& rule) {
  if (rule.response == Response::Bounce) return;
  if (reader.has("restitution")) reader.reject("restitution", "belongs to response = \"bounce\" only");
  if (rule.response == Response::Slide) return;
  constexpr std::string_view kProblem =
      "cannot be true with this response: it belongs to \"bounce\" and \"slide\"";
  if (reader.has("separate") && rule.separate) reader.reject("separate", kProblem);
  if (reader.has("approaching_only") && rule.approachingOnly) reader.reject("approaching_only", kProblem);
}

/// The solver always separates, and never holds together what parts.
void rejectWhatTheSolverLacks(const SceneBuilder& builder, const TableReader& reader,
                              const ContactRule& rule) {
  if (builder.scene.world.contactModel != ContactModel::Solver || rule.response != Response::Bounce) return;
  constexpr std::string_view kProblem = "cannot be false for a bounce with [world] contacts = \"solver\"";
  if (reader.has("separate") && !rule.separate) reader.reject("separate", kProblem);
  if (reader.has("approaching_only") && !rule.approachingOnly) reader.reject("approaching_only", kProblem);
}

} // namespace

void parseCollide(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"collide"}, "[[collide]]", builder.errors);
  ContactRule rule;
  const bool groupsKnown = readGroups(builder, reader, rule);
  rule.response = reader.choice("response", kResponses);
  rule.restitution = reader.number("restitution", Range::between(0.0, 1.0));
  // A slide is shown as it is printed, and that moves nobody: the oracle's 6c. So only a bounce separates
  // unasked.
  rule.separate = reader.has("separate") ? reader.boolean("separate") : rule.response == Response::Bounce;
  rule.approachingOnly = reader.boolean("approaching_only");
  rejectWhatTheResponseLacks(reader, rule);
  rejectWhatTheSolverLacks(builder, reader, rule);
  std::vector<std::uint32_t> except = readExceptions(builder, reader, rule, groupsKnown);
  if (!groupsKnown) return;

  const auto pair = std::minmax(rule.groupA, rule.groupB);
  const auto [place, isNew] = builder.ruleOfGroups.try_emplace(pair, builder.groupRules.size());
  if (!isNew) {
    reader.reject("between",
                  fmt::format("has a rule already, in line {}", builder.groupRules[place->second].line));
    return;
  }
  builder.groupRules.push_back({rule, std::move(except), table.line, &table});
}

} // namespace offstage
