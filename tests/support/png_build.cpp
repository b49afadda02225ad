#include "tests/support/png_build.h"

#include <array>
#include <cstdlib>
#include <zlib.h>

namespace offstage::test {
namespace {

struct Pass {
  int x, y, stepX, stepY;
};

std::vector<Pass> passesOf(const PngSpec& spec) {
  if (!spec.interlaced) return {{0, 0, 1, 1}};
  return {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
}

/// The samples of a row, packed.
std::string packedRow(const PngSpec& spec, const Samples& samples, const Pass& pass, int y) {
  std::string row;
  unsigned bits = 0;
  int held = 0;
  for (int x = pass.x; x < spec.width; x += pass.stepX) {
    for (int channel = 0; channel < channelsOf(spec); ++channel) {
      const unsigned sample = samples(x, y, channel);
      if (spec.depth == 16) row += static_cast<char>(sample >> 8U);
      if (spec.depth >= 8) {
        row += static_cast<char>(sample & 0xFFU);
        continue;
      }
      bits = (bits << static_cast<unsigned>(spec.depth)) | sample;
      held += spec.depth;
      if (held == 8) {
        row += static_cast<char>(bits);
        bits = 0;
        held = 0;
      }
    }
  }
  if (held > 0) row += static_cast<char>(bits << static_cast<unsigned>(8 - held));
  return row;
}

int byteAt(const std::string& row, std::size_t index) {
  return static_cast<std::uint8_t>(row[index]);
}

std::string filtered(const std::string& row, const std::string& above, int filter, std::size_t pixel) {
  std::string result(1, static_cast<char>(filter));
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int a = i >= pixel ? byteAt(row, i - pixel) : 0;
    const int b = above.empty() ? 0 : byteAt(above, i);
    const int c = above.empty() || i < pixel ? 0 : byteAt(above, i - pixel);
    int predicted = 0;
    if (filter == 1) predicted = a;
    if (filter == 2) predicted = b;
    if (filter == 3) predicted = (a + b) / 2;
    if (filter == 4) {
      const int p = a + b - c;
      predicted = c;
      if (std::abs(p - b) <= std::abs(p - c)) predicted = b;
      if (std::abs(p - a) <= std::abs(p - b) && std::abs(p - a) <= std::abs(p - c)) predicted = a;
    }
    result += static_cast<char>(byteAt(row, i) - predicted);
  }
  return result;
}

} // namespace

int channelsOf(const PngSpec& spec) {
  constexpr std::array<int, 7> kChannels{1, 0, 3, 1, 2, 0, 4};
  return kChannels.at(static_cast<std::size_t>(spec.color));
}

std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> static_cast<unsigned>(shift));
  return bytes;
}

std::string pngChunk(const std::string& type, const std::string& data) {
  const std::string covered = type + data;
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(covered.data()), static_cast<uInt>(covered.size()));
  return bigEndian(static_cast<std::uint32_t>(data.size())) + covered +
         bigEndian(static_cast<std::uint32_t>(crc));
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
            static_cast<uLong>(bytes.size()), 6);
  result.resize(size);
  return result;
}

std::string pngHeader(std::uint32_t width, std::uint32_t height, int depth, int color, int interlaced) {
  return bigEndian(width) + bigEndian(height) + static_cast<char>(depth) + static_cast<char>(color) +
         std::string(2, '\0') + static_cast<char>(interlaced);
}

std::string pngOf(const std::string& header, const std::string& chunks) {
  return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + chunks;
}

std::string makePng(const PngSpec& spec, const Samples& samples) {
  const std::size_t pixel = static_cast<std::size_t>(std::max(1, channelsOf(spec) * spec.depth / 8));
  std::string rows;
  int number = 0;
  for (const Pass& pass : passesOf(spec)) {
    if (pass.x >= spec.width) continue;
    std::string above;
    for (int y = pass.y; y < spec.height; y += pass.stepY) {
      const std::string row = packedRow(spec, samples, pass, y);
      rows += filtered(row, above, spec.filter == 5 ? number++ % 5 : spec.filter, pixel);
      above = row;
    }
  }
  const std::string data = deflated(rows);
  std::string chunks = spec.before;
  if (!spec.palette.empty()) chunks += pngChunk("PLTE", spec.palette);
  if (!spec.transparency.empty()) chunks += pngChunk("tRNS", spec.transparency);
  const std::size_t piece = data.size() / static_cast<std::size_t>(spec.idatPieces) + 1;
  for (std::size_t at = 0; at < data.size(); at += piece) chunks += pngChunk("IDAT", data.substr(at, piece));
  return pngOf(pngHeader(static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height),
                         spec.depth, spec.color, spec.interlaced ? 1 : 0),
               chunks + pngChunk("IEND", ""));
}

} // namespace offstage::test
