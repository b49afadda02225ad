#pragma once

#include "src/scene/look.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace offstage {

/// A decoded picture to fill shapes with: RGBA, 8 bits each, rows top-down, alpha not premultiplied.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba; ///< width*height*4
};

/// Larger files are not read: no picture of the largest size needs more, compressed or not.
constexpr std::size_t kLargestImageFile = 4UL * 16384 * 16384 + (1UL << 20);

/// Decodes a PNG (PngPicture: strictly), JPEG or BMP (stb_image). Throws std::runtime_error that says what is
/// wrong, without a file's name.
Image decodeImage(std::vector<std::uint8_t> bytes);

/// Decodes a PNG, JPEG or BMP file. `where` locates the key that named the file and may be empty.
/// Throws SceneError (located) or Error(BadInput) when it is missing, not an image, damaged, empty, or larger
/// than 16384 px a side (checked before memory is taken).
Image loadImage(const std::filesystem::path& file, const SourceLocation& where = {});

/// Images by file, each decoded once. Not thread-safe.
class ImageCache {
public:
  std::shared_ptr<const Image> get(const ImagePattern& pattern);

private:
  std::vector<std::pair<std::filesystem::path, std::shared_ptr<const Image>>> images_;
};

} // namespace offstage
