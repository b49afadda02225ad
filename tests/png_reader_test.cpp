#include "render/draw/png_reader.h"
#include "tests/support/png_build.h"

#include <array>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::uint8_t> bytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

/// What the reader says is wrong with a file; "good" when it takes it.
std::string faultOf(const std::string& file, std::int64_t maxPixels = kDefaultMaxPixels) {
  try {
    const PngPicture picture(bytesOf(file), maxPixels);
    return "good";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

unsigned noise(int x, int y, int channel, int depth) {
  std::uint32_t v = static_cast<std::uint32_t>(x) * 2654435761U +
                    static_cast<std::uint32_t>(y) * 40503U * 65537U +
                    static_cast<std::uint32_t>(channel) * 97U;
  v ^= v >> 15U;
  v *= 2246822519U;
  v ^= v >> 13U;
  return v & ((1U << static_cast<unsigned>(depth)) - 1U);
}

std::string fullPalette(int depth) {
  std::string palette;
  for (int i = 0; i < 1 << depth; ++i)
    palette += {static_cast<char>(i * 7), static_cast<char>(255 - i), static_cast<char>(i * 31)};
  return palette;
}

/// RGBA of 16 bits that a sample set means.
std::array<unsigned, 4> meant(const PngSpec& spec, const Samples& samples, int x, int y) {
  const unsigned largest = (1U << static_cast<unsigned>(spec.depth)) - 1U;
  const auto full = [&](int channel) { return samples(x, y, channel) * 65535U / largest; };
  switch (spec.color) {
  case 0:
    return {full(0), full(0), full(0), 65535};
  case 2:
    return {full(0), full(1), full(2), 65535};
  case 3: {
    const std::size_t index = samples(x, y, 0);
    const auto channel = [&](std::size_t c) {
      return static_cast<std::uint8_t>(spec.palette[3 * index + c]) * 257U;
    };
    const unsigned alpha = index < spec.transparency.size()
                               ? static_cast<std::uint8_t>(spec.transparency[index]) * 257U
                               : 65535U;
    return {channel(0), channel(1), channel(2), alpha};
  }
  case 4:
    return {full(0), full(0), full(0), full(1)};
  default:
    return {full(0), full(1), full(2), full(3)};
  }
}

void expectPixels(const PngSpec& spec, const std::string& what) {
  const Samples samples = [&](int x, int y, int channel) { return noise(x, y, channel, spec.depth); };
  const PngPicture picture(bytesOf(makePng(spec, samples)));
  ASSERT_EQ(picture.width(), spec.width) << what;
  ASSERT_EQ(picture.height(), spec.height) << what;
  std::vector<std::uint8_t> buffer(4UL * static_cast<std::size_t>(spec.width));
  std::vector<std::uint16_t> deep(buffer.size());
  for (int y = 0; y < spec.height; ++y) {
    const std::uint8_t* row = picture.row8(y, buffer.data());
    picture.row16(y, deep.data());
    for (int x = 0; x < spec.width; ++x) {
      const std::array<unsigned, 4> wanted = meant(spec, samples, x, y);
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t at = 4 * static_cast<std::size_t>(x) + c;
        ASSERT_EQ(deep[at], wanted.at(c)) << what << " at " << x << ", " << y << " channel " << c;
        ASSERT_EQ(row[at], (wanted.at(c) * 255U + 32767U) / 65535U)
            << what << " at " << x << ", " << y << " channel " << c;
      }
    }
  }
}

TEST(PngReader, ReadsEveryColourTypeDepthFilterAndInterlacing) {
  const std::vector<std::pair<int, std::vector<int>>> kinds{
      {0, {1, 2, 4, 8, 16}}, {2, {8, 16}}, {3, {1, 2, 4, 8}}, {4, {8, 16}}, {6, {8, 16}}};
  for (const auto& [color, depths] : kinds) {
    for (const int depth : depths) {
      for (const bool interlaced : {false, true}) {
        for (int filter = 0; filter <= 5; ++filter) {
          for (const auto& [width, height] :
               std::vector<std::pair<int, int>>{{1, 1}, {3, 9}, {13, 7}, {67, 11}}) {
            PngSpec spec{width, height, depth, color, interlaced, filter, 3, {}, {}, {}};
            if (color == 3) {
              spec.palette = fullPalette(depth);
              spec.transparency = "\x80\x01";
            }
            expectPixels(spec, fmt::format("colour {} depth {} interlaced {} filter {} size {}x{}", color,
                                           depth, interlaced, filter, width, height));
            if (HasFatalFailure()) return;
          }
        }
      }
    }
  }
}

TEST(PngReader, TransparentColoursHaveAlpha0) {
  const auto alphaOf = [](PngSpec spec, const std::string& key, unsigned sample) {
    spec.transparency = key;
    const PngPicture picture(bytesOf(makePng(spec, [&](int, int, int) { return sample; })));
    std::array<std::uint8_t, 4> buffer{};
    return picture.row8(0, buffer.data())[3];
  };
  const std::string nul(1, '\0');
  EXPECT_EQ(alphaOf({.color = 2}, nul + "\x07" + nul + "\x07" + nul + "\x07", 7), 0);
  EXPECT_EQ(alphaOf({.color = 2}, nul + "\x07" + nul + "\x07" + nul + "\x07", 8), 255);
  EXPECT_EQ(alphaOf({.color = 2}, "\x01\x07\x01\x07\x01\x07", 7), 255)
      << "a key beyond 8 bits names no colour";
  EXPECT_EQ(alphaOf({.color = 0}, nul + "\x07", 7), 0);
  EXPECT_EQ(alphaOf({.depth = 16, .color = 0}, "\x12\x34", 0x1234), 0);
  EXPECT_EQ(alphaOf({.depth = 16, .color = 2}, "\x12\x34\x12\x34\x12\x34", 0x1234), 0);
  EXPECT_EQ(alphaOf({.depth = 16, .color = 2}, "\x12\x34\x12\x34\x12\x34", 0x1235), 255);
}

std::string goodPng() {
  return makePng({.width = 4, .height = 3, .color = 2},
                 [](int x, int y, int c) { return noise(x, y, c, 8); });
}

TEST(PngReader, EveryFaultIsNamed) {
  const std::string good = goodPng();
  ASSERT_EQ(faultOf(good), "good");
  const std::string header = pngHeader(4, 3, 8, 2);
  const std::string rows(3 * 13, '\0');
  const std::string data = pngChunk("IDAT", deflated(rows));
  const std::string end = pngChunk("IEND", "");
  std::string wrongCrc = good;
  wrongCrc[good.find("IDAT") + 6] ^= 1;
  std::string adler = deflated(rows);
  adler.back() ^= 1;
  std::string broken = deflated(std::string(2000, 'x'));
  broken[2] = '\x07';
  const std::string indexed = pngHeader(4, 3, 8, 3);
  const std::string twoColours = pngChunk("PLTE", std::string(6, '\0'));
  const std::string third = pngChunk("IDAT", deflated(std::string(13, '\0') + std::string(2, '\2')));
  std::string lastRow = rows;
  lastRow[2 * 13] = '\x05';
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "is not a PNG"},
      {"GIF89a", "is not a PNG"},
      {good.substr(0, 10), "is truncated (in the head of a chunk at byte 8)"},
      {good.substr(0, 40), "is truncated (in the head of a chunk"},
      {good.substr(0, 60), "is truncated (chunk IDAT at byte 33 needs"},
      {good.substr(0, good.size() - 12), "is truncated (no IEND chunk)"},
      {good.substr(0, good.size() - 1), "is truncated (chunk IEND"},
      {wrongCrc, "is damaged (CRC of chunk IDAT at byte 33 is"},
      {pngOf(header, pngChunk("IDAT", adler) + end), "Adler-32 checksum"},
      {pngOf(header, pngChunk("IDAT", deflated(rows).substr(0, 8)) + end), "cut off"},
      {pngOf(header, pngChunk("IDAT", broken) + end), "compressed pixel data are broken"},
      {pngOf(header, pngChunk("IDAT", deflated(rows.substr(1))) + end),
       "38 bytes of pixels where 4x3 px have 39"},
      {pngOf(header, pngChunk("IDAT", deflated(rows + "x")) + end), "more pixel data than 4x3 px have"},
      {pngOf(header, pngChunk("IDAT", deflated(lastRow)) + end), "row 2 has the unknown filter 5"},
      {pngOf(header, end), "no IDAT chunk"},
      {pngOf(header, data + pngChunk("tEXt", "a") + data + end), "does not follow the others"},
      {pngOf(header, data + pngChunk("IEND", "x")), "IEND has 1 bytes"},
      {pngOf(header, pngChunk("ABCD", "") + data + end), "unknown chunk ABCD at byte 33"},
      {pngOf(header, pngChunk("IHDR", header) + data + end), "a second chunk IHDR"},
      {pngOf(header, pngChunk("1234", "") + data + end), "no chunk's name"},
      {pngOf(header.substr(1), data + end), "IHDR has 12 bytes"},
      {"\x89PNG\r\n\x1a\n" + data + end, "the first chunk is IDAT, not IHDR"},
      {pngOf(pngHeader(0, 3, 8, 2), data + end), "IHDR: 0x3 px"},
      {pngOf(pngHeader(0x80000000U, 3, 8, 2), data + end), "IHDR: 2147483648x3 px"},
      {pngOf(pngHeader(0x7FFFFFFFU, 0x7FFFFFFFU, 8, 2), data + end),
       "more than the limit of 268435456 pixels"},
      {pngOf(pngHeader(16000, 16000, 8, 2), data + end), "too few for 16000x16000 px"},
      {pngOf(pngHeader(4, 3, 3, 2), data + end), "3 bits a sample with colour type 2"},
      {pngOf(pngHeader(4, 3, 16, 3), data + end), "16 bits a sample with colour type 3"},
      {pngOf(pngHeader(4, 3, 8, 5), data + end), "unknown colour type 5"},
      {pngOf(pngHeader(4, 3, 8, 2, 2), data + end), "unknown interlacing 2"},
      {pngOf(indexed, data + end), "no PLTE chunk before the pixels"},
      {pngOf(indexed, pngChunk("PLTE", std::string(7, 'a')) + data + end), "PLTE has 7 bytes"},
      {pngOf(pngHeader(4, 3, 2, 3), pngChunk("PLTE", std::string(15, 'a')) + data + end),
       "PLTE has 15 bytes"},
      {pngOf(pngHeader(4, 3, 8, 0), twoColours + data + end), "grey picture with a PLTE"},
      {pngOf(indexed, twoColours + twoColours + data + end), "two PLTE chunks"},
      {pngOf(indexed, pngChunk("tRNS", "a") + twoColours + data + end), "tRNS before PLTE"},
      {pngOf(indexed, twoColours + pngChunk("tRNS", "abc") + data + end), "tRNS has 3 bytes"},
      {pngOf(pngHeader(4, 3, 8, 6), pngChunk("tRNS", "a") + data + end), "tRNS in a picture with alpha"},
      {pngOf(indexed, twoColours + third + end), "pixel 2, 2 has colour 2 of a palette of 2"},
      {pngOf(pngHeader(1, 1, 8, 3), twoColours + pngChunk("IDAT", deflated(std::string("\0\2", 2))) + end),
       "pixel 0, 0 has colour 2 of a palette of 2"},
      {pngOf(header, pngChunk("gAMA", "ab") + data + end), "gAMA has 2 bytes"},
  };
  for (const auto& [file, wanted] : cases) EXPECT_THAT(faultOf(file), HasSubstr(wanted)) << wanted;
}

TEST(PngReader, NoTruncationAndNoFlippedByteIsTaken) {
  const std::string good = goodPng();
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_NE(faultOf(good.substr(0, size)), "good") << "the first " << size << " bytes";
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string flipped = good;
    flipped[at] ^= 0x10;
    EXPECT_NE(faultOf(flipped), "good") << "byte " << at;
  }
}

TEST(PngReader, ASizeIsRefusedBeforeMemoryIsTaken) {
  EXPECT_THAT(faultOf(goodPng(), 11), HasSubstr("claims 4x3 px, more than the limit of 11 pixels"));
  EXPECT_EQ(faultOf(goodPng(), 12), "good");
}

TEST(PngReader, WhatIsHarmlessIsNoticed) {
  EXPECT_THAT(PngPicture(bytesOf(goodPng())).notices(), IsEmpty());
  EXPECT_THAT(PngPicture(bytesOf(goodPng() + "more")).notices(),
              ElementsAre("has 4 bytes after IEND, which are ignored"));
  const auto withGamma = [](std::uint32_t gamma) {
    return makePng({.color = 0, .before = pngChunk("gAMA", bigEndian(gamma))},
                   [](int, int, int) { return 9U; });
  };
  EXPECT_THAT(PngPicture(bytesOf(withGamma(45455))).notices(), IsEmpty());
  EXPECT_THAT(PngPicture(bytesOf(withGamma(100000))).notices(),
              ElementsAre("has gamma 1.00000, which is not applied"));
}

} // namespace
} // namespace offstage::test
