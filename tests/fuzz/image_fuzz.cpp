#include "render/draw/image.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

/// Any bytes are an image of the size that it says, or are refused with an exception.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const offstage::Image image = offstage::decodeImage({data, data + size});
    if (image.rgba.size() !=
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4)
      __builtin_trap();
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
