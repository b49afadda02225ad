#include "render/draw/image.h"
#include "src/sim/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <unistd.h>

/// Any file is an image of the size that it says, or is refused with an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("offstage_image_fuzz_" + std::to_string(getpid()));
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) return 0;
  std::fwrite(data, 1, size, out);
  std::fclose(out);
  try {
    const offstage::Image image = offstage::loadImage(file);
    if (image.rgba.size() !=
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4)
      __builtin_trap();
  } catch (const offstage::Error&) {
    return 0;
  }
  return 0;
}
