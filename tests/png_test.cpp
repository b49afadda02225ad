#include "render/output/png.h"
#include "tests/support/test_frames.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>
#include <zlib.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace offstage {
namespace {

using test::errorOf;
using test::flatFrame;
using test::lectureFrame;
using test::noiseFrame;
using testing::ElementsAre;

std::uint32_t bigEndian(const std::uint8_t* bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24U | static_cast<std::uint32_t>(bytes[1]) << 16U |
         static_cast<std::uint32_t>(bytes[2]) << 8U | bytes[3];
}

struct Chunk {
  std::string type;
  std::vector<std::uint8_t> data;
};

/// Takes a PNG apart by the specification; zlib's CRC is independent of the one that wrote it.
std::vector<Chunk> chunksOf(const std::vector<std::uint8_t>& png) {
  std::vector<Chunk> chunks;
  EXPECT_EQ(std::memcmp(png.data(), "\x89PNG\r\n\x1a\n", 8), 0);
  std::size_t at = 8;
  while (at + 12 <= png.size()) {
    const std::size_t size = bigEndian(&png[at]);
    if (at + 12 + size > png.size()) break;
    Chunk chunk{std::string(reinterpret_cast<const char*>(&png[at + 4]), 4), {}};
    chunk.data.assign(png.begin() + static_cast<std::ptrdiff_t>(at + 8),
                      png.begin() + static_cast<std::ptrdiff_t>(at + 8 + size));
    EXPECT_EQ(bigEndian(&png[at + 8 + size]), crc32(0, &png[at + 4], static_cast<uInt>(4 + size)))
        << chunk.type;
    chunks.push_back(chunk);
    at += 12 + size;
  }
  EXPECT_EQ(at, png.size()) << "bytes that belong to no chunk";
  return chunks;
}

std::vector<std::string> typesOf(const std::vector<Chunk>& chunks) {
  std::vector<std::string> types;
  types.reserve(chunks.size());
  for (const Chunk& chunk : chunks) types.push_back(chunk.type);
  return types;
}

/// Pixels as RGBA, whatever the file holds; `channels` is what it holds.
std::vector<std::uint8_t> decode(const std::vector<std::uint8_t>& png, int& width, int& height,
                                 int& channels) {
  stbi_uc* pixels =
      stbi_load_from_memory(png.data(), static_cast<int>(png.size()), &width, &height, &channels, 4);
  if (pixels == nullptr) return {};
  std::vector<std::uint8_t> rgba(pixels, pixels + static_cast<std::ptrdiff_t>(width) * height * 4);
  stbi_image_free(pixels);
  return rgba;
}

void expectReadBackEqual(const Frame& frame, bool alpha) {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint8_t> expected = frame.rgba;
  if (!alpha) {
    for (std::size_t i = 3; i < expected.size(); i += 4) expected[i] = 255;
  }
  const std::vector<std::uint8_t> found = decode(encodePng(frame, alpha), width, height, channels);
  EXPECT_EQ(width, frame.width);
  EXPECT_EQ(height, frame.height);
  EXPECT_EQ(channels, alpha ? 4 : 3);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(found[i], expected[i]) << frame.width << " × " << frame.height << ", byte " << i;
  }
}

TEST(Png, PixelsReadBackEqualAtEveryWidthAndSize) {
  for (int width = 1; width <= 9; ++width) { // the packing into RGB goes by four pixels
    for (const bool alpha : {false, true}) expectReadBackEqual(noiseFrame(width, 3, 7), alpha);
  }
  for (const bool alpha : {false, true}) {
    expectReadBackEqual(lectureFrame(320, 240, 5), alpha);
    expectReadBackEqual(noiseFrame(641, 359, 3), alpha);
    expectReadBackEqual(flatFrame(4000, 1, {1, 2, 3, 4}), alpha);
  }
}

TEST(Png, ChunksAreThoseThatTheHeaderPromises) {
  const Frame frame = lectureFrame(33, 17, 0);
  const std::vector<Chunk> plain = chunksOf(encodePng(frame, false));
  EXPECT_THAT(typesOf(plain), ElementsAre("IHDR", "sRGB", "IDAT", "IEND"));
  EXPECT_THAT(plain[0].data, ElementsAre(0, 0, 0, 33, 0, 0, 0, 17, 8, 2, 0, 0, 0));
  EXPECT_THAT(plain[1].data, ElementsAre(0));

  const std::vector<Chunk> dense = chunksOf(encodePng(frame, true, 3780));
  EXPECT_THAT(typesOf(dense), ElementsAre("IHDR", "sRGB", "pHYs", "IDAT", "IEND"));
  EXPECT_EQ(dense[0].data[9], 6);
  EXPECT_THAT(dense[2].data, ElementsAre(0, 0, 0x0E, 0xC4, 0, 0, 0x0E, 0xC4, 1));
}

TEST(Png, RowsInflateToUnfilteredPixels) {
  const Frame frame = noiseFrame(5, 4, 11);
  const std::vector<Chunk> chunks = chunksOf(encodePng(frame, true));
  std::vector<std::uint8_t> rows(4 * (1 + 5 * 4));
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(rows.data(), &size, chunks[2].data.data(), chunks[2].data.size()), Z_OK);
  ASSERT_EQ(size, rows.size());
  for (std::size_t y = 0; y < 4; ++y) {
    EXPECT_EQ(rows[y * 21], 0) << "filter of row " << y;
    EXPECT_EQ(std::memcmp(&rows[y * 21 + 1], &frame.rgba[y * 20], 20), 0) << "row " << y;
  }
}

TEST(Png, EncoderThatIsUsedAgainGivesTheBytesOfAFreshOne) {
  PngEncoder encoder;
  for (const int size : {300, 20, 150}) {
    const Frame frame = lectureFrame(size, size, size);
    const auto bytes = encoder.encode(frame, false);
    EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), encodePng(frame, false)) << size;
  }
}

TEST(Png, DamagedFramesGiveTheBytesOfWholeOnes) {
  for (const bool alpha : {false, true}) {
    PngEncoder encoder;
    Frame frame = noiseFrame(61, 40, 1);
    for (std::uint64_t id = 1; id <= 20; ++id) {
      frame.base = id - 1;
      frame.id = id;
      frame.damage.clear();
      for (int i = 0; id > 1 && i < 2; ++i) {
        const int left = static_cast<int>(id * 7 % 50);
        const int top = static_cast<int>(id * 11 % 30) / 2 + 10 * i;
        frame.damage.push_back({left, top, left + 11, top + 9});
        for (int row = top; row < top + 9; ++row) {
          for (int column = left; column < left + 11; ++column)
            frame.rgba[test::pixelIndex(row, 61, column) * 4 + id % 4] ^= 0x5A;
        }
      }
      const auto bytes = encoder.encode(frame, alpha);
      ASSERT_EQ(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), encodePng(frame, alpha)) << id;
    }
  }
}

TEST(Png, RefusesFramesThatAreNoPictures) {
  Frame torn = lectureFrame(10, 10, 0);
  torn.rgba.pop_back();
  EXPECT_EQ(errorOf([&torn] { encodePng(torn, false); }),
            "2: a frame of 10 × 10 px holds 399 bytes instead of 400");
  EXPECT_EQ(errorOf([] { encodePng(Frame{}, false); }), "2: a frame of 0 × 0 px has no pixels");
  Frame negative = lectureFrame(10, 10, 0);
  negative.width = negative.height = -10;
  EXPECT_EQ(errorOf([&negative] { encodePng(negative, true); }), "2: a frame of -10 × -10 px has no pixels");
  EXPECT_EQ(errorOf([] { encodePng(lectureFrame(2, 2, 0), true, -1); }),
            "2: a PNG's resolution must not be negative");
}

} // namespace
} // namespace offstage
