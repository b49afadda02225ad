#include "render/draw/image.h"

#include "render/draw/jpeg_tables.h"
#include "src/scene/diagnostic.h"
#include "src/sim/error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>

#include <fmt/format.h>
#define STBI_NO_STDIO
#include <stb/stb_image.h>

namespace offstage {
namespace {

constexpr int kLargestSide = 16384; // px

/// Larger files are not read: no image of the largest size needs more, compressed or not.
constexpr std::size_t kLargestFile = 4UL * kLargestSide * kLargestSide + (1UL << 20);

[[noreturn]] void fail(const SourceLocation& where, const std::filesystem::path& file,
                       const std::string& reason) {
  const std::string message = fmt::format("image '{}': {}", file.string(), reason);
  if (where.file.empty()) throw Error(ExitCode::BadInput, message);
  throw SceneError({Diagnostic{where, message}});
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// The whole file, or nothing when it cannot be read; `reason` then says why.
std::optional<std::vector<std::uint8_t>> readFile(const std::filesystem::path& path, std::string& reason) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    reason = "is a folder";
    return std::nullopt;
  }
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) {
    reason = std::strerror(errno);
    return std::nullopt;
  }
  std::vector<std::uint8_t> bytes;
  constexpr std::size_t kChunk = 1UL << 16;
  for (std::size_t got = kChunk; got == kChunk;) { // grows with what is there: a device or pipe tells no size
    const std::size_t size = bytes.size();
    if (size > kLargestFile) {
      reason = fmt::format("is larger than {} bytes", kLargestFile);
      return std::nullopt;
    }
    bytes.resize(size + kChunk);
    got = std::fread(bytes.data() + size, 1, kChunk, file.get());
    bytes.resize(size + got);
  }
  if (std::ferror(file.get()) != 0) {
    reason = std::strerror(errno);
    return std::nullopt;
  }
  return bytes;
}

} // namespace

Image loadImage(const std::filesystem::path& file, const SourceLocation& where) {
  std::string reason;
  const auto bytes = readFile(file, reason);
  if (!bytes) fail(where, file, reason);
  if (bytes->empty()) fail(where, file, "is empty");
  // stb counts bytes in int; a file beyond that cannot be handed over.
  if (bytes->size() > 0x7fffffffUL) fail(where, file, "is larger than 2 GiB");
  const auto length = static_cast<int>(bytes->size());

  if (!jpegTablesFit(*bytes)) fail(where, file, "is damaged (a Huffman table with more than 256 codes)");

  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(bytes->data(), length, &width, &height, &channels) == 0) {
    fail(where, file, fmt::format("cannot be read as PNG, JPEG or BMP ({})", stbi_failure_reason()));
  }
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    fail(where, file, fmt::format("is {}x{} px; each side may be 1 to {}", width, height, kLargestSide));
  }
  // A few bytes must not claim a gigabyte: deflate, the densest of the formats' codings, packs at most 1032
  // bytes into one, and a pixel has at least one bit.
  if (static_cast<std::int64_t>(width) * height > static_cast<std::int64_t>(length) * 1032 * 8) {
    fail(where, file, fmt::format("is damaged (too short for {}x{} px)", width, height));
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes->data(), length, &width, &height, &channels, STBI_rgb_alpha),
      stbi_image_free);
  if (pixels == nullptr) fail(where, file, fmt::format("is damaged ({})", stbi_failure_reason()));
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.assign(pixels.get(), pixels.get() + 4L * width * height);
  return image;
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
