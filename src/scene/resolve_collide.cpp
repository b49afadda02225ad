#include "src/scene/limits.h"
#include "src/scene/quote.h"
#include "src/scene/scene_builder.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include <fmt/core.h>

namespace offstage {
namespace {

using GroupRule = SceneBuilder::GroupRule;

constexpr std::uint32_t kAny = GroupRule::kAny;

bool isOpen(const GroupRule& rule) {
  return rule.rule.groupA == kAny || rule.rule.groupB == kAny;
}

/// The rule between these, kAny being one of a name, when its "*" stand for what they have to. Null: none.
const GroupRule* ruleBetween(const SceneBuilder& builder, std::uint32_t first, std::uint32_t second,
                             std::initializer_list<std::uint32_t> meant) {
  const auto found = builder.ruleOfGroups.find(std::minmax(first, second));
  if (found == builder.ruleOfGroups.end()) return nullptr;
  const GroupRule& rule = builder.groupRules[found->second];
  const bool excepted = std::any_of(meant.begin(), meant.end(), [&rule](std::uint32_t group) {
    return std::find(rule.except.begin(), rule.except.end(), group) != rule.except.end();
  });
  return excepted ? nullptr : &rule;
}

/// The rule of two groups: that which names both, else one, else none of them. Null when there is none, or
/// when each of the two has one of its own for all others, which is reported.
const GroupRule* ruleOf(SceneBuilder& builder, std::uint32_t first, std::uint32_t second) {
  if (const GroupRule* rule = ruleBetween(builder, first, second, {})) return rule;
  const GroupRule* ofFirst = ruleBetween(builder, first, kAny, {second});
  const GroupRule* ofSecond = ruleBetween(builder, second, kAny, {first});
  if (ofFirst == nullptr && ofSecond == nullptr) return ruleBetween(builder, kAny, kAny, {first, second});
  if (ofFirst == nullptr || ofSecond == nullptr || ofFirst == ofSecond)
    return ofFirst != nullptr ? ofFirst : ofSecond;
  const std::vector<std::string>& groups = builder.scene.world.groups;
  builder.errors.add(*ofSecond->table,
                     fmt::format("{} and {} have two rules, in lines {} and {}: give the two a rule of their "
                                 "own, or let one of them 'except' the other",
                                 quotedText(groups[first]), quotedText(groups[second]), ofFirst->line,
                                 ofSecond->line));
  return nullptr;
}

} // namespace

void addContacts(SceneBuilder& builder) {
  std::vector<ContactRule>& contacts = builder.scene.world.contacts;
  const auto open = std::find_if(builder.groupRules.begin(), builder.groupRules.end(), isOpen);
  if (open == builder.groupRules.end()) {
    for (const GroupRule& rule : builder.groupRules) contacts.push_back(rule.rule);
    return;
  }
  const auto groups = static_cast<std::uint32_t>(builder.scene.world.groups.size());
  if (groups > kMaxGroupsOfAll) {
    builder.errors.add(*open->table, fmt::format("\"*\" stands for {} groups; it may for at most {}", groups,
                                                 kMaxGroupsOfAll));
    return;
  }
  for (std::uint32_t first = 0; first < groups; ++first) {
    for (std::uint32_t second = first; second < groups; ++second) {
      const GroupRule* rule = ruleOf(builder, first, second);
      if (rule == nullptr) continue;
      ContactRule& contact = contacts.emplace_back(rule->rule);
      contact.groupA = first;
      contact.groupB = second;
    }
  }
}

} // namespace offstage
