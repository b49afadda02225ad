#include "src/scene/scene_builder.h"

#include "src/scene/nearest.h"
#include "src/scene/quote.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

#include <fmt/core.h>

namespace offstage {
namespace {

using Names = std::map<std::string, std::uint32_t, std::less<>>;

/// Among more names than this nobody's typo is looked for: a hostile file could make that take hours.
constexpr std::size_t kMostSuggested = 1000;

/// The index of a name that must be known. `kind`: "group", "body".
std::optional<std::uint32_t> findName(const Names& names, const TomlValue& value, const std::string& what,
                                      std::string_view kind, ErrorList& errors) {
  const auto* name = std::get_if<std::string>(&value.data);
  if (name == nullptr) {
    reportMismatch(value, what, fmt::format("the name of a {}", kind), errors);
    return std::nullopt;
  }
  if (const auto found = names.find(*name); found != names.end()) return found->second;
  if (errors.full()) return std::nullopt;
  std::vector<std::string_view> known;
  if (names.size() <= kMostSuggested) {
    for (const auto& [candidate, index] : names) known.emplace_back(candidate);
  }
  const std::string_view near = nearest(*name, known);
  std::string hint;
  if (!near.empty()) {
    hint = fmt::format("; did you mean {}?", quotedText(near));
  } else if (names.empty()) {
    hint = fmt::format("; the scene has no {}", kind == "body" ? "named body" : kind);
  }
  errors.add(value, fmt::format("{} names an unknown {}, {}{}", what, kind, quotedText(*name), hint));
  return std::nullopt;
}

} // namespace

SceneBuilder::SceneBuilder(const std::filesystem::path& file) : errors(file.string()) {
  scene.file = file;
  scene.world.groups.clear(); // they come with the bodies that name them
}

void SceneBuilder::requireFinite(const TomlValue& table, const std::string& label,
                                 std::initializer_list<double> numbers) {
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
    return;
  errors.add(table, fmt::format("a number in {} is too large for this [view]", label));
}

std::uint32_t SceneBuilder::addGroup(const std::string& name) {
  const auto [place, isNew] = groups.try_emplace(name, static_cast<std::uint32_t>(groups.size()));
  if (isNew) scene.world.groups.push_back(name);
  return place->second;
}

std::optional<std::uint32_t> SceneBuilder::findGroup(const TomlValue& value, const std::string& what) {
  return findName(groups, value, what, "group", errors);
}

std::optional<std::uint32_t> SceneBuilder::findBody(const TomlValue& value, const std::string& what) {
  return findName(bodies, value, what, "body", errors);
}

std::optional<Anchor> SceneBuilder::readAnchor(const TableReader& reader, std::string_view key) {
  const TomlValue* value = reader.find(key);
  if (value == nullptr) {
    reader.require(key);
    return std::nullopt;
  }
  const std::string what = reader.described(key);
  if (std::holds_alternative<std::string>(value->data)) {
    const auto body = findBody(*value, what);
    if (!body) return std::nullopt;
    return Anchor{Vec2::Zero(), body};
  }
  if (value->array() == nullptr) {
    reportMismatch(*value, what, "[x, y] or a body's name", errors);
    return std::nullopt;
  }
  const auto point = reader.givenNumbers<2>(key);
  if (!point) return std::nullopt;
  return Anchor{view.position({(*point)[0], (*point)[1]}), std::nullopt};
}

bool SceneBuilder::isPointer(const TableReader& reader, std::string_view key) {
  const TomlValue* value = reader.find(key);
  const auto* word = value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
  if (word == nullptr || *word != "mouse" || bodies.contains("mouse")) return false;
  if (!input) reader.reject(key, "is the pointer of recorded input, but the scene has no [input]");
  return true;
}

std::optional<std::filesystem::path> SceneBuilder::readFile(const TableReader& reader, std::string_view key) {
  const auto name = reader.givenString(key);
  if (!name) return std::nullopt;
  const auto reject = [&](const std::string& problem) {
    reader.reject(key, fmt::format("names the file {}, {}", quotedText(*name), problem));
    return std::nullopt;
  };
  // A path with a zero byte would silently be cut there by the operating system's calls.
  if (name->find('\0') != std::string::npos) return reject("but a file's name holds no zero byte");
  std::filesystem::path file = scene.file.parent_path() / *name; // an absolute path stays as it is
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    return reject("which does not exist beside the scene");
  }
  if (!std::filesystem::status_known(status)) return reject("which cannot be looked up: " + error.message());
  if (!std::filesystem::is_regular_file(status)) return reject("which is no regular file");
  return file;
}

const TomlValue* singleTable(const TableReader& top, std::string_view key) {
  const TomlValue* value = top.find(key);
  if (value == nullptr || value->table() != nullptr) return value;
  reportMismatch(*value, top.described(key), fmt::format("one table, [{}]", key), top.errors());
  return nullptr;
}

void parseSingle(SceneBuilder& builder, const TableReader& top, std::string_view key,
                 void (*parse)(SceneBuilder&, const TomlValue&)) {
  if (const TomlValue* table = singleTable(top, key)) parse(builder, *table);
}

void parseEach(SceneBuilder& builder, const TableReader& top, std::string_view key,
               void (*parse)(SceneBuilder&, const TomlValue&)) {
  const TomlValue* value = top.find(key);
  if (value == nullptr) return;
  const std::string wanted = fmt::format("an array of tables, [[{}]]", key);
  if (value->array() == nullptr || value->array()->empty()) {
    reportMismatch(*value, top.described(key), wanted, builder.errors);
    return;
  }
  for (const TomlValue& element : *value->array()) {
    if (element.table() == nullptr) {
      reportMismatch(element, "every value of " + top.described(key), "a table", builder.errors);
    } else {
      parse(builder, element);
    }
  }
}

} // namespace offstage
