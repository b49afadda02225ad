#include "render/raster/frame.h"

#include <array>

#define XXH_STATIC_LINKING_ONLY // the streaming state on the stack
#include <xxhash.h>

namespace offstage {

std::uint64_t Frame::hash() const {
  std::array<std::uint8_t, 8> size{};
  for (unsigned i = 0; i < 4; ++i) {
    size[i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(width) >> (8U * i));
    size[4 + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(height) >> (8U * i));
  }
  XXH3_state_t state;
  XXH3_INITSTATE(&state);
  XXH3_64bits_reset(&state);
  XXH3_64bits_update(&state, size.data(), size.size());
  XXH3_64bits_update(&state, rgba.data(), rgba.size());
  return XXH3_64bits_digest(&state);
}

} // namespace offstage
