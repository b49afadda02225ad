#include "render/compare/ignore.h"

#include "render/draw/image.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace offstage {
namespace {

void addMask(BitPlane& plane, const std::filesystem::path& file, int width, int height) {
  const Image mask = loadImage(file);
  if (mask.width != width || mask.height != height)
    throw Error(ExitCode::BadInput, fmt::format("mask '{}' is {}x{} px, the pictures are {}x{}",
                                                file.string(), mask.width, mask.height, width, height));
  const std::uint8_t* rgba = mask.rgba.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, rgba += 4) {
      const int luma = (299 * rgba[0] + 587 * rgba[1] + 114 * rgba[2]) / 1000;
      if (luma * rgba[3] + 255 * (255 - rgba[3]) < 128 * 255) plane.set(x, y);
    }
  }
}

} // namespace

BitPlane ignoredPixels(const Tolerance& tolerance, int width, int height) {
  if (tolerance.ignore.empty() && tolerance.masks.empty()) return {};
  BitPlane plane(width, height);
  for (const IgnoredRegion& region : tolerance.ignore) {
    const int right = static_cast<int>(std::min<std::int64_t>(width, std::int64_t{region.x} + region.width));
    const int bottom =
        static_cast<int>(std::min<std::int64_t>(height, std::int64_t{region.y} + region.height));
    for (int y = std::max(0, region.y); y < bottom; ++y)
      for (int x = std::max(0, region.x); x < right; ++x) plane.set(x, y);
  }
  for (const std::filesystem::path& file : tolerance.masks) addMask(plane, file, width, height);
  return plane;
}

IgnoringRows::IgnoringRows(const PixelRows& actual, const PixelRows& expected, const BitPlane& ignored)
    : actual_(actual),
      expected_(expected),
      ignored_(ignored),
      layout_(fmt::format("ignoring {}", static_cast<const void*>(this))) {}

const std::uint8_t* IgnoringRows::row8(int y, std::uint8_t* buffer) const {
  const std::size_t bytes = 4UL * static_cast<std::size_t>(width());
  const std::uint8_t* from = actual_.row8(y, buffer);
  if (ignored_.countRow(y) == 0) return from;
  if (from != buffer) std::memcpy(buffer, from, bytes);
  std::vector<std::uint8_t> other(bytes);
  const std::uint8_t* expected = expected_.row8(y, other.data());
  ignored_.forEachInRow(y, [&](int x) {
    const std::size_t at = 4UL * static_cast<std::size_t>(x);
    std::memcpy(buffer + at, expected + at, 4);
  });
  return buffer;
}

void IgnoringRows::row16(int y, std::uint16_t* buffer) const {
  actual_.row16(y, buffer);
  std::vector<std::uint16_t> expected(4UL * static_cast<std::size_t>(width()));
  expected_.row16(y, expected.data());
  ignored_.forEachInRow(y, [&](int x) {
    const std::size_t at = 4UL * static_cast<std::size_t>(x);
    std::copy_n(&expected[at], 4, buffer + at);
  });
}

} // namespace offstage
