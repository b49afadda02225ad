#include "render/draw/png_reader.h"

#include "render/draw/png_unfilter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <stdexcept>

#include <fmt/format.h>
#include <libdeflate.h>

namespace offstage {
namespace {

using Color = PngHeader::Color;

static_assert(std::endian::native == std::endian::little, "pixels are packed into words red first");

/// One of Adam7's seven pictures: the pixels from (x, y) in steps (8.2).
struct Pass {
  int x, y, stepX, stepY;
};
constexpr std::array<Pass, 7> kAdam7{
    {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};

int pixelsOf(int whole, int start, int step) {
  return whole <= start ? 0 : (whole - start + step - 1) / step;
}

int wholePixelBytes(const PngHeader& header) {
  return std::max(1, header.pixelBits() / 8);
}

/// Sample `index` of a row of samples of 1, 2, 4 or 8 bits, the first in the highest bits.
unsigned sampleAt(const std::uint8_t* row, std::size_t index, int depth) {
  const std::size_t bit = index * static_cast<std::size_t>(depth);
  const auto shift = 8U - static_cast<unsigned>(depth) - static_cast<unsigned>(bit % 8);
  return (static_cast<unsigned>(row[bit / 8]) >> shift) & ((1U << static_cast<unsigned>(depth)) - 1U);
}

void putSample(std::uint8_t* row, std::size_t index, int depth, unsigned sample) {
  const std::size_t bit = index * static_cast<std::size_t>(depth);
  const auto shift = 8U - static_cast<unsigned>(depth) - static_cast<unsigned>(bit % 8);
  row[bit / 8] = static_cast<std::uint8_t>(row[bit / 8] | (sample << shift));
}

std::uint16_t sample16(const std::uint8_t* from) {
  return static_cast<std::uint16_t>((static_cast<unsigned>(from[0]) << 8U) | from[1]);
}

/// v·255/65535, rounded: (v + 128)/257.
std::uint8_t roundedTo8(std::uint16_t value) {
  return static_cast<std::uint8_t>((static_cast<unsigned>(value) + 128U) / 257U);
}

std::uint32_t packed(unsigned red, unsigned green, unsigned blue, unsigned alpha) {
  return red | (green << 8U) | (blue << 16U) | (alpha << 24U);
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
};

} // namespace

PngPicture::PngPicture(std::vector<std::uint8_t> file, std::int64_t maxPixels)
    : chunks_(readPngChunks(file, maxPixels)) {
  stride_ = 1 + header().rowBytes(width());
  inflate();
  chunks_.data = {}; // `file` ends with this constructor
  if (header().interlaced)
    unfilterInterlaced();
  else
    unfilter();
  resolvePalette();
  requirePaletteIndices();
  describeLayout();
}

void PngPicture::inflate() {
  const PngHeader& header = chunks_.header;
  std::size_t bytes = 0;
  if (header.interlaced) {
    for (const Pass& pass : kAdam7) {
      const int columns = pixelsOf(width(), pass.x, pass.stepX);
      const int rows = pixelsOf(height(), pass.y, pass.stepY);
      if (columns > 0) bytes += static_cast<std::size_t>(rows) * (1 + header.rowBytes(columns));
    }
  } else {
    bytes = stride_ * static_cast<std::size_t>(height());
  }
  const std::span<const std::uint8_t> data = chunks_.data;
  // Deflate packs at most 1032 bytes into one: a few bytes must not claim a gigabyte.
  constexpr std::size_t kDensest = 1032;
  if (bytes / kDensest > data.size())
    throw std::runtime_error(fmt::format("is damaged ({} bytes of pixel data are too few for {}x{} px)",
                                         data.size(), width(), height()));

  rows_ = std::make_unique_for_overwrite<std::uint8_t[]>(bytes + kUnfilterSlack);
  std::fill_n(rows_.get() + bytes, kUnfilterSlack, std::uint8_t{0});
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  if (decompressor == nullptr) throw std::bad_alloc();
  std::size_t used = 0;
  std::size_t made = 0;
  switch (libdeflate_zlib_decompress_ex(decompressor.get(), data.data(), data.size(), rows_.get(), bytes,
                                        &used, &made)) {
  case LIBDEFLATE_SUCCESS:
    break;
  case LIBDEFLATE_INSUFFICIENT_SPACE:
    throw std::runtime_error(
        fmt::format("is damaged (more pixel data than {}x{} px have)", width(), height()));
  case LIBDEFLATE_BAD_DATA:
  default: {
    // Which of the two: the stream between the zlib header and its Adler-32 may be whole.
    constexpr std::size_t kHead = 2;
    constexpr std::size_t kTail = 4;
    if (data.size() > kHead + kTail &&
        libdeflate_deflate_decompress(decompressor.get(), data.data() + kHead, data.size() - kHead,
                                      rows_.get(), bytes, nullptr) == LIBDEFLATE_SUCCESS)
      throw std::runtime_error("is damaged (the Adler-32 checksum of the pixel data is wrong or cut off)");
    throw std::runtime_error("is damaged (the compressed pixel data are broken or cut off)");
  }
  }
  if (made != bytes)
    throw std::runtime_error(fmt::format("is damaged ({} bytes of pixels where {}x{} px have {})", made,
                                         width(), height(), bytes));
  if (used != data.size())
    chunks_.notices.push_back(
        fmt::format("has {} bytes behind its pixel data, which are ignored", data.size() - used));
}

void PngPicture::unfilter() {
  const auto bad = unfilterRows(rows_.get(), height(), stride_ - 1, wholePixelBytes(header()));
  if (bad)
    throw std::runtime_error(
        fmt::format("is damaged (row {} has the unknown filter {})", *bad, *(at(*bad) - 1)));
}

void PngPicture::unfilterInterlaced() {
  const std::size_t bytes = stride_ * static_cast<std::size_t>(height());
  auto whole = std::make_unique<std::uint8_t[]>(bytes + kUnfilterSlack);
  std::uint8_t* data = rows_.get();
  const auto pixelBits = static_cast<std::size_t>(header().pixelBits());
  for (const Pass& pass : kAdam7) {
    const int columns = pixelsOf(width(), pass.x, pass.stepX);
    const int rows = pixelsOf(height(), pass.y, pass.stepY);
    if (columns == 0) continue;
    const std::size_t rowBytes = header().rowBytes(columns);
    if (unfilterRows(data, rows, rowBytes, wholePixelBytes(header())))
      throw std::runtime_error("is damaged (an interlaced row has an unknown filter)");
    for (int row = 0; row < rows; ++row, data += 1 + rowBytes) {
      const int y = pass.y + row * pass.stepY;
      std::uint8_t* to = whole.get() + 1 + static_cast<std::size_t>(y) * stride_;
      for (int column = 0; column < columns; ++column) {
        const auto from = static_cast<std::size_t>(column);
        const int target = pass.x + column * pass.stepX;
        const auto x = static_cast<std::size_t>(target);
        if (pixelBits >= 8)
          std::memcpy(to + x * pixelBits / 8, data + 1 + from * pixelBits / 8, pixelBits / 8);
        else
          putSample(to, x, header().depth, sampleAt(data + 1, from, header().depth));
      }
    }
  }
  rows_ = std::move(whole);
}

void PngPicture::resolvePalette() {
  const PngHeader& header = chunks_.header;
  if (header.color == Color::Palette) {
    for (std::size_t i = 0; i < chunks_.palette.size() / 3; ++i) {
      const std::uint8_t* rgb = &chunks_.palette[3 * i];
      const unsigned alpha = i < chunks_.transparency.size() ? chunks_.transparency[i] : 255U;
      colors_.push_back(packed(rgb[0], rgb[1], rgb[2], alpha));
    }
  } else if (header.color == Color::Grey && header.depth <= 8) {
    const unsigned largest = (1U << static_cast<unsigned>(header.depth)) - 1U;
    const bool keyed = !chunks_.transparency.empty();
    const unsigned key = keyed ? sample16(chunks_.transparency.data()) : 0U;
    for (unsigned sample = 0; sample <= largest; ++sample) {
      const unsigned grey = sample * (255U / largest);
      colors_.push_back(packed(grey, grey, grey, keyed && sample == key ? 0U : 255U));
    }
  }
}

void PngPicture::requirePaletteIndices() const {
  const PngHeader& header = chunks_.header;
  if (header.color != Color::Palette || colors_.size() == 1UL << static_cast<unsigned>(header.depth)) return;
  for (int y = 0; y < height(); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(width()); ++x) {
      const unsigned index = sampleAt(at(y), x, header.depth);
      if (index >= colors_.size())
        throw std::runtime_error(fmt::format("is damaged (pixel {}, {} has colour {} of a palette of {})", x,
                                             y, index, colors_.size()));
    }
  }
}

void PngPicture::describeLayout() {
  const PngHeader& header = chunks_.header;
  layout_ = fmt::format("png {} {} ", static_cast<int>(header.color), header.depth);
  if (header.color == Color::Palette) layout_.append(chunks_.palette.begin(), chunks_.palette.end());
  layout_ += '/';
  layout_.append(chunks_.transparency.begin(), chunks_.transparency.end());
  if (header.color == Color::Rgba && header.depth == 8) layout_ = kRgba8Layout;
}

std::span<const std::uint8_t> PngPicture::stored(int y) const {
  return {at(y), stride_ - 1};
}

const std::uint8_t* PngPicture::row8(int y, std::uint8_t* buffer) const {
  const PngHeader& header = chunks_.header;
  const std::uint8_t* from = at(y);
  const auto pixels = static_cast<std::size_t>(width());
  const auto put = [buffer](std::size_t x, std::uint32_t rgba) { std::memcpy(buffer + 4 * x, &rgba, 4); };
  if (!colors_.empty()) {
    if (header.depth == 8) {
      for (std::size_t x = 0; x < pixels; ++x) put(x, colors_[from[x]]);
    } else {
      for (std::size_t x = 0; x < pixels; ++x) put(x, colors_[sampleAt(from, x, header.depth)]);
    }
    return buffer;
  }
  if (header.depth == 16) {
    std::vector<std::uint16_t> deepRow(4 * pixels);
    row16(y, deepRow.data());
    for (std::size_t i = 0; i < deepRow.size(); ++i) buffer[i] = roundedTo8(deepRow[i]);
    return buffer;
  }
  switch (header.color) {
  case Color::Rgba:
    return from;
  case Color::GreyAlpha:
    for (std::size_t x = 0; x < pixels; ++x)
      put(x, packed(from[2 * x], from[2 * x], from[2 * x], from[2 * x + 1]));
    return buffer;
  case Color::Rgb:
  default: {
    // Rows end in others or in slack, so four bytes may be read at each pixel.
    for (std::size_t x = 0; x < pixels; ++x) {
      std::uint32_t rgb = 0;
      std::memcpy(&rgb, from + 3 * x, 4);
      put(x, rgb | 0xFF000000U);
    }
    if (chunks_.transparency.empty()) return buffer;
    const std::uint8_t* key = chunks_.transparency.data();
    // A key beyond 8 bits names no colour of this picture.
    if (key[0] != 0 || key[2] != 0 || key[4] != 0) return buffer;
    const std::uint32_t opaque = packed(key[1], key[3], key[5], 255);
    for (std::size_t x = 0; x < pixels; ++x) {
      std::uint32_t rgba = 0;
      std::memcpy(&rgba, buffer + 4 * x, 4);
      if (rgba == opaque) put(x, rgba & 0x00FFFFFFU);
    }
    return buffer;
  }
  }
}

void PngPicture::row16(int y, std::uint16_t* buffer) const {
  const auto pixels = static_cast<std::size_t>(width());
  if (header().depth != 16) {
    std::vector<std::uint8_t> row(4 * pixels);
    const std::uint8_t* from = row8(y, row.data());
    for (std::size_t i = 0; i < 4 * pixels; ++i) buffer[i] = static_cast<std::uint16_t>(from[i] * 257);
    return;
  }
  const std::uint8_t* from = at(y);
  const bool grey = header().color == Color::Grey || header().color == Color::GreyAlpha;
  const bool alpha = header().color == Color::GreyAlpha || header().color == Color::Rgba;
  const std::size_t colors = grey ? 1 : 3;
  const std::size_t bytes = 2 * (colors + (alpha ? 1 : 0));
  for (std::size_t x = 0; x < pixels; ++x, from += bytes) {
    std::uint16_t* to = buffer + 4 * x;
    for (std::size_t c = 0; c < 3; ++c) to[c] = sample16(from + (grey ? 0 : 2 * c));
    to[3] = alpha ? sample16(from + 2 * colors) : 0xFFFFU;
    if (!chunks_.transparency.empty() && std::memcmp(from, chunks_.transparency.data(), bytes) == 0)
      to[3] = 0;
  }
}

} // namespace offstage
