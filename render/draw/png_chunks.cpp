#include "render/draw/png_chunks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <libdeflate.h>

namespace offstage {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t kLargestNumber = 0x7FFFFFFF; // of any four-byte integer (7.1)
constexpr std::size_t kAroundData = 12;              // length, type and CRC of a chunk
constexpr std::size_t kLargestPalette = 3UL * 256;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

std::uint32_t bigEndian(const std::uint8_t* from) {
  return (static_cast<std::uint32_t>(from[0]) << 24U) | (static_cast<std::uint32_t>(from[1]) << 16U) |
         (static_cast<std::uint32_t>(from[2]) << 8U) | static_cast<std::uint32_t>(from[3]);
}

/// A chunk's place in the file.
struct Chunk {
  std::size_t at = 0; ///< of its length field
  std::string_view type;
  std::span<std::uint8_t> data;
};

/// The chunk at `at`, its CRC checked.
Chunk readChunk(std::span<std::uint8_t> file, std::size_t at) {
  if (at == file.size()) fail("is truncated (no IEND chunk)");
  if (file.size() - at < 8) fail(fmt::format("is truncated (in the head of a chunk at byte {})", at));
  const std::uint32_t length = bigEndian(&file[at]);
  Chunk chunk{at, {reinterpret_cast<const char*>(&file[at + 4]), 4}, {}};
  const bool letters = std::ranges::all_of(
      chunk.type, [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); });
  if (!letters) fail(fmt::format("is damaged (no chunk's name at byte {})", at + 4));
  if (length > kLargestNumber)
    fail(fmt::format("is damaged (chunk {} at byte {} claims {} bytes)", chunk.type, at, length));
  if (file.size() - at - 8 < length + 4UL)
    fail(fmt::format("is truncated (chunk {} at byte {} needs {} bytes, {} are there)", chunk.type, at,
                     length + kAroundData, file.size() - at));
  chunk.data = file.subspan(at + 8, length);
  // The CRC covers type and data.
  const std::uint32_t stored = bigEndian(&file[at + 8 + length]);
  const std::uint32_t computed = libdeflate_crc32(0, &file[at + 4], 4UL + length);
  if (stored != computed)
    fail(fmt::format("is damaged (CRC of chunk {} at byte {} is {:08x}, its bytes give {:08x})", chunk.type,
                     at, stored, computed));
  return chunk;
}

void requireDepth(int depth, std::uint8_t color) {
  const auto allowed = [&](std::initializer_list<int> depths) {
    if (std::ranges::find(depths, depth) == depths.end())
      fail(fmt::format("is damaged (IHDR: {} bits a sample with colour type {})", depth, color));
  };
  switch (color) {
  case 0:
    return allowed({1, 2, 4, 8, 16});
  case 3:
    return allowed({1, 2, 4, 8});
  case 2:
  case 4:
  case 6:
    return allowed({8, 16});
  default:
    fail(fmt::format("is damaged (IHDR: unknown colour type {})", color));
  }
}

PngHeader readHeader(const Chunk& chunk, std::int64_t maxPixels) {
  if (chunk.type != "IHDR") fail(fmt::format("is damaged (the first chunk is {}, not IHDR)", chunk.type));
  if (chunk.data.size() != 13) fail(fmt::format("is damaged (IHDR has {} bytes, not 13)", chunk.data.size()));
  const std::uint32_t width = bigEndian(chunk.data.data());
  const std::uint32_t height = bigEndian(&chunk.data[4]);
  if (width == 0 || height == 0 || width > kLargestNumber || height > kLargestNumber)
    fail(fmt::format("is damaged (IHDR: {}x{} px)", width, height));
  if (static_cast<std::int64_t>(width) * height > maxPixels)
    fail(fmt::format("claims {}x{} px, more than the limit of {} pixels", width, height, maxPixels));
  requireDepth(chunk.data[8], chunk.data[9]);
  if (chunk.data[10] != 0) fail(fmt::format("is damaged (IHDR: unknown compression {})", chunk.data[10]));
  if (chunk.data[11] != 0) fail(fmt::format("is damaged (IHDR: unknown filter method {})", chunk.data[11]));
  if (chunk.data[12] > 1) fail(fmt::format("is damaged (IHDR: unknown interlacing {})", chunk.data[12]));
  PngHeader header;
  header.width = static_cast<int>(width);
  header.height = static_cast<int>(height);
  header.depth = chunk.data[8];
  header.color = static_cast<PngHeader::Color>(chunk.data[9]);
  header.interlaced = chunk.data[12] == 1;
  return header;
}

/// Gathers the chunks behind the header in the order in which they come.
class Reader {
public:
  Reader(std::span<std::uint8_t> file, const PngHeader& header) : file_(file) { result_.header = header; }

  /// False after IEND.
  bool take(const Chunk& chunk) {
    if (chunk.type == "IEND") {
      if (!chunk.data.empty()) fail(fmt::format("is damaged (IEND has {} bytes)", chunk.data.size()));
      return false;
    }
    if (chunk.type == "IDAT")
      takeData(chunk);
    else if (chunk.type == "PLTE")
      takePalette(chunk);
    else if (chunk.type == "tRNS")
      takeTransparency(chunk);
    else if (chunk.type == "gAMA")
      takeGamma(chunk);
    else if (chunk.type == "acTL")
      result_.notices.emplace_back("is animated; only its still picture is looked at");
    else if (std::isupper(static_cast<unsigned char>(chunk.type[0])) != 0) // critical (5.4)
      fail(fmt::format("is damaged ({} chunk {} at byte {})", chunk.type == "IHDR" ? "a second" : "unknown",
                       chunk.type, chunk.at));
    return true;
  }

  PngChunks finish() {
    if (!dataSeen_) fail("is damaged (no IDAT chunk)");
    result_.data = file_.subspan(dataBegin_, dataEnd_ - dataBegin_);
    return std::move(result_);
  }

private:
  using Color = PngHeader::Color;

  void takeData(const Chunk& chunk) {
    if (result_.header.color == Color::Palette && result_.palette.empty())
      fail("is damaged (no PLTE chunk before the pixels)");
    if (!dataSeen_) {
      dataSeen_ = true;
      dataBegin_ = dataEnd_ = chunk.at;
    } else if (chunk.at != lastDataChunkEnd_) {
      fail(fmt::format("is damaged (IDAT chunk at byte {} does not follow the others)", chunk.at));
    }
    std::memmove(&file_[dataEnd_], chunk.data.data(), chunk.data.size());
    dataEnd_ += chunk.data.size();
    lastDataChunkEnd_ = chunk.at + kAroundData + chunk.data.size();
  }

  void takePalette(const Chunk& chunk) {
    const PngHeader& header = result_.header;
    const std::size_t size = chunk.data.size();
    if (!result_.palette.empty()) fail("is damaged (two PLTE chunks)");
    if (dataSeen_) fail("is damaged (PLTE after the pixels)");
    if (header.color == Color::Grey || header.color == Color::GreyAlpha)
      fail("is damaged (a grey picture with a PLTE chunk)");
    const bool indexed = header.color == Color::Palette;
    if (size == 0 || size % 3 != 0 || size > kLargestPalette || (indexed && size / 3 > 1UL << header.depth))
      fail(fmt::format("is damaged (PLTE has {} bytes)", size));
    result_.palette.assign(chunk.data.begin(), chunk.data.end());
  }

  void takeTransparency(const Chunk& chunk) {
    const std::size_t size = chunk.data.size();
    if (dataSeen_) fail("is damaged (tRNS after the pixels)");
    if (!result_.transparency.empty()) fail("is damaged (two tRNS chunks)");
    bool good = false;
    switch (result_.header.color) {
    case Color::Grey:
      good = size == 2;
      break;
    case Color::Rgb:
      good = size == 6;
      break;
    case Color::Palette:
      if (result_.palette.empty()) fail("is damaged (tRNS before PLTE)");
      good = size >= 1 && size <= result_.palette.size() / 3;
      break;
    case Color::GreyAlpha:
    case Color::Rgba:
      fail("is damaged (tRNS in a picture with alpha)");
    }
    if (!good) fail(fmt::format("is damaged (tRNS has {} bytes)", size));
    result_.transparency.assign(chunk.data.begin(), chunk.data.end());
  }

  void takeGamma(const Chunk& chunk) {
    if (chunk.data.size() != 4) fail(fmt::format("is damaged (gAMA has {} bytes)", chunk.data.size()));
    result_.gamma = bigEndian(chunk.data.data());
    constexpr std::uint32_t kOfSrgb = 45455; // 1/2.2
    if (*result_.gamma != kOfSrgb)
      result_.notices.push_back(
          fmt::format("has gamma {:.5f}, which is not applied", *result_.gamma / 100000.0));
  }

  std::span<std::uint8_t> file_;
  PngChunks result_;
  bool dataSeen_ = false;
  std::size_t dataBegin_ = 0;
  std::size_t dataEnd_ = 0;
  std::size_t lastDataChunkEnd_ = 0;
};

} // namespace

int PngHeader::channels() const {
  switch (color) {
  case Color::Rgb:
    return 3;
  case Color::GreyAlpha:
    return 2;
  case Color::Rgba:
    return 4;
  case Color::Grey:
  case Color::Palette:
    break;
  }
  return 1;
}

std::size_t PngHeader::rowBytes(int pixels) const {
  return (static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixelBits()) + 7) / 8;
}

bool isPng(std::span<const std::uint8_t> file) {
  return file.size() >= kSignature.size() && std::equal(kSignature.begin(), kSignature.end(), file.begin());
}

PngChunks readPngChunks(std::span<std::uint8_t> file, std::int64_t maxPixels) {
  if (!isPng(file)) fail("is not a PNG");
  std::size_t at = kSignature.size();
  const Chunk first = readChunk(file, at);
  Reader reader(file, readHeader(first, maxPixels));
  at += kAroundData + first.data.size();
  for (bool more = true; more;) {
    const Chunk chunk = readChunk(file, at);
    // Before the chunk is taken, which may move bytes over its head.
    at += kAroundData + chunk.data.size();
    more = reader.take(chunk);
  }
  PngChunks chunks = reader.finish();
  if (at != file.size())
    chunks.notices.push_back(fmt::format("has {} bytes after IEND, which are ignored", file.size() - at));
  return chunks;
}

} // namespace offstage
