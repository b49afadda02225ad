#include "render/draw/image.h"

#include "render/draw/file_bytes.h"
#include "render/draw/jpeg_tables.h"
#include "render/draw/png_reader.h"
#include "src/scene/diagnostic.h"
#include "src/sim/error.h"

#include <cstring>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#define STBI_NO_STDIO
#include <stb/stb_image.h>

namespace offstage {
namespace {

constexpr int kLargestSide = 16384; // px

void requireSides(int width, int height) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    throw std::runtime_error(
        fmt::format("is {}x{} px; each side may be 1 to {}", width, height, kLargestSide));
}

[[noreturn]] void fail(const SourceLocation& where, const std::filesystem::path& file,
                       const std::string& reason) {
  const std::string message = fmt::format("image '{}': {}", file.string(), reason);
  if (where.file.empty()) throw Error(ExitCode::BadInput, message);
  throw SceneError({Diagnostic{where, message}});
}

Image decodePng(std::vector<std::uint8_t> bytes) {
  const PngPicture picture(std::move(bytes));
  requireSides(picture.width(), picture.height());
  Image image;
  image.width = picture.width();
  image.height = picture.height();
  const std::size_t rowBytes = 4UL * static_cast<std::size_t>(image.width);
  image.rgba.resize(rowBytes * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* to = image.rgba.data() + static_cast<std::size_t>(y) * rowBytes;
    const std::uint8_t* row = picture.row8(y, to);
    if (row != to) std::memcpy(to, row, rowBytes);
  }
  return image;
}

Image decodeOther(const std::vector<std::uint8_t>& bytes) {
  // stb counts bytes in int; a file beyond that cannot be handed over.
  if (bytes.size() > 0x7fffffffUL) throw std::runtime_error("is larger than 2 GiB");
  const auto length = static_cast<int>(bytes.size());
  if (!jpegTablesFit(bytes))
    throw std::runtime_error("is damaged (a Huffman table with more than 256 codes)");

  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), length, &width, &height, &channels) == 0)
    throw std::runtime_error(fmt::format("cannot be read as PNG, JPEG or BMP ({})", stbi_failure_reason()));
  requireSides(width, height);
  // A few bytes must not claim a gigabyte: no coding of these formats packs a pixel into less than 1/8256
  // byte.
  if (static_cast<std::int64_t>(width) * height > static_cast<std::int64_t>(length) * 1032 * 8)
    throw std::runtime_error(fmt::format("is damaged (too short for {}x{} px)", width, height));
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, STBI_rgb_alpha),
      stbi_image_free);
  if (pixels == nullptr) throw std::runtime_error(fmt::format("is damaged ({})", stbi_failure_reason()));
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.assign(pixels.get(), pixels.get() + 4L * width * height);
  return image;
}

} // namespace

Image decodeImage(std::vector<std::uint8_t> bytes) {
  if (isPng(bytes)) return decodePng(std::move(bytes));
  return decodeOther(bytes);
}

Image loadImage(const std::filesystem::path& file, const SourceLocation& where) {
  try {
    return decodeImage(readFileBytes(file, kLargestImageFile));
  } catch (const std::runtime_error& error) {
    fail(where, file, error.what());
  }
}

std::shared_ptr<const Image> ImageCache::get(const ImagePattern& pattern) {
  for (const auto& [file, image] : images_) {
    if (file == pattern.file) return image;
  }
  auto image = std::make_shared<const Image>(loadImage(pattern.file, pattern.where));
  images_.emplace_back(pattern.file, image);
  return image;
}

} // namespace offstage
