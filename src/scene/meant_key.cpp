#include "src/scene/meant_key.h"

#include "src/scene/scene_keys.h"

#include <algorithm>

namespace offstage {
namespace {

struct MeantKey {
  std::string_view table; ///< of sceneKeyTable()
  std::string_view wrong;
  std::string_view meant; ///< a key of the table
};

// clang-format off
constexpr MeantKey kMeant[] = {
    {"frame", "color", "background"},
    {"body", "color", "fill"},
    {"body", "vx", "velocity"},
    {"body", "vy", "velocity"},
    {"body", "ax", "acceleration"},
    {"body", "ay", "acceleration"},
    {"body", "x", "center"},
    {"body", "y", "center"},
    {"body", "width", "size"},
    {"body", "height", "size"},
    {"spawn", "color", "fill"},
    {"spawn", "max", "limit"},
    {"launch", "color", "fill"},
    {"launch", "to", "toward"},
    {"text", "fill", "color"},
    {"text", "position", "at"},
    {"caption", "at", "from"},
    {"pause", "duration", "for"},
    {"camera", "duration", "for"},
};
// clang-format on

bool holds(std::span<const std::string_view> tables, std::string_view table) {
  return std::ranges::find(tables, table) != tables.end();
}

} // namespace

std::string_view meantKey(std::string_view key, std::span<const std::string_view> tables) {
  const std::string_view word = key == "colour" ? "color" : key;
  for (const MeantKey& candidate : kMeant)
    if (candidate.wrong == word && holds(tables, candidate.table)) return candidate.meant;
  if (word == key) return {};
  for (const SceneKey* candidate : sceneKeysNamed(word))
    if (holds(tables, candidate->table)) return candidate->key;
  return {};
}

} // namespace offstage
