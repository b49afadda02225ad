#include "src/sim/event.h"

#include <array>
#include <cstddef>

namespace offstage {

std::string_view name(EventKind kind) {
  static constexpr std::array<std::string_view, 11> kNames{
      "spawn", "fire", "nofire", "left", "right", "top", "bottom", "hit", "collide", "touch", "leave"};
  return kNames.at(static_cast<std::size_t>(kind));
}

} // namespace offstage
