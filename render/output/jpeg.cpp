#include "render/output/jpeg.h"

#include "src/sim/error.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace offstage {

std::vector<std::uint8_t> encodeJpeg(const Frame& frame) {
  constexpr int kQuality = 92; // above 90 the library keeps the colour of every pixel
  constexpr int kChannels = 4;
  std::vector<std::uint8_t> file;
  const auto append = [](void* to, void* data, int size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    static_cast<std::vector<std::uint8_t>*>(to)->insert(static_cast<std::vector<std::uint8_t>*>(to)->end(),
                                                        bytes, bytes + size);
  };
  if (stbi_write_jpg_to_func(append, &file, frame.width, frame.height, kChannels, frame.rgba.data(),
                             kQuality) == 0)
    throw Error(ExitCode::BadInput, "a JPEG needs a picture of at least one pixel");
  return file;
}

} // namespace offstage
