#include "render/output/pixel_deflate.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <vector>
#include <zlib.h>

#include <gtest/gtest.h>
#include <libdeflate.h>

namespace offstage {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The pixels of rows, each of one byte and `width` pixels, with any fourth byte where there are three
/// channels.
Bytes rgbaOf(const Bytes& rows, std::size_t width, std::size_t channels) {
  Bytes rgba;
  std::uint8_t fourth = 0;
  for (std::size_t row = 0; row < rows.size(); row += 1 + width * channels) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* const pixel = &rows[row + 1 + x * channels];
      rgba.insert(rgba.end(), pixel, pixel + channels);
      if (channels == 3) rgba.push_back(fourth++);
    }
  }
  return rgba;
}

/// A deflater for pictures of one width, and what it makes of them in a buffer that is certainly large
/// enough.
class TestDeflater {
public:
  TestDeflater(std::size_t width, std::size_t channels)
      : width_(width), channels_(channels), deflater_(width, channels) {}

  std::size_t compress(const Bytes& rows, std::span<std::uint8_t> to) {
    const Bytes rgba = rgbaOf(rows, width_, channels_);
    // Rows come into being just before they are read.
    const std::size_t rowBytes = 1 + width_ * channels_;
    Bytes made(rows.size(), 0x5A);
    std::size_t next = 0;
    const auto prepare = [&](std::size_t row) {
      EXPECT_EQ(row, next++);
      std::memcpy(&made[row * rowBytes], &rows[row * rowBytes], rowBytes);
    };
    return deflater_.compress(made, rgba.data(), prepare, to);
  }

  Bytes compressed(const Bytes& rows) {
    Bytes stream(2 * rows.size() + 2000);
    stream.resize(compress(rows, stream));
    return stream;
  }

private:
  std::size_t width_;
  std::size_t channels_;
  PixelDeflater deflater_;
};

/// zlib is the judge: it checks the codes' completeness and the checksum.
void expectInflatesTo(const Bytes& rows, const Bytes& stream) {
  Bytes found(rows.size());
  uLongf size = found.size();
  ASSERT_EQ(uncompress(found.data(), &size, stream.data(), stream.size()), Z_OK) << rows.size() << " bytes";
  ASSERT_EQ(size, rows.size());
  ASSERT_TRUE(found == rows);
}

/// Rectangles of a few colours over each other, with some single pixels: runs, edges that go on below,
/// changes.
Bytes flatRows(std::mt19937& random, std::size_t width, std::size_t height, std::size_t channels) {
  const std::size_t rowBytes = 1 + width * channels;
  Bytes rows(rowBytes * height, 255);
  for (std::size_t y = 0; y < height; ++y) rows[y * rowBytes] = 0;
  const auto paint = [&](std::size_t left, std::size_t top, std::size_t right, std::size_t bottom) {
    const auto color = static_cast<std::uint32_t>(random());
    for (std::size_t y = top; y < std::min(bottom, height); ++y) {
      for (std::size_t x = left; x < std::min(right, width); ++x)
        std::memcpy(&rows[y * rowBytes + 1 + x * channels], &color, channels);
    }
  };
  for (int i = 0; i < 12; ++i) {
    const std::size_t left = random() % width;
    const std::size_t top = random() % height;
    paint(left, top, left + random() % width, top + random() % height);
  }
  for (std::size_t i = 0; i < width * height / 20; ++i) {
    const std::size_t left = random() % width;
    const std::size_t top = random() % height;
    paint(left, top, left + 1, top + 1);
  }
  return rows;
}

TEST(PixelDeflate, FlatPicturesOfManySizesInflateToThemselves) {
  std::mt19937 random(1);
  int flat = 0; // some are by chance full of changes
  for (int round = 0; round < 400; ++round) {
    const std::size_t channels = 3 + random() % 2;
    const std::size_t width = 1 + random() % (round % 4 == 0 ? 700 : 60);
    const std::size_t height = 1 + random() % 60;
    const Bytes rows = flatRows(random, width, height, channels);
    TestDeflater deflater(width, channels);
    const Bytes stream = deflater.compressed(rows);
    if (stream.empty()) continue; // by chance not flat
    ++flat;
    expectInflatesTo(rows, stream);
  }
  EXPECT_GT(flat, 300) << "of 400";
}

TEST(PixelDeflate, RowsLongerThanTheWindowAreRunsOnly) {
  std::mt19937 random(2);
  for (const std::size_t width : {10922U, 10923U, 16000U}) { // 1 + 3·10922 = 32767 bytes reach just so far
    const Bytes rows = flatRows(random, width, 9, 3);
    TestDeflater deflater(width, 3);
    const Bytes stream = deflater.compressed(rows);
    ASSERT_FALSE(stream.empty());
    expectInflatesTo(rows, stream);
  }
}

TEST(PixelDeflate, PicturesOfSeveralBlocksInflateToThemselves) {
  std::mt19937 random(3);
  const Bytes rows = flatRows(random, 1600, 1200, 3); // some 190,000 matches, and a block holds 65,536
  TestDeflater deflater(1600, 3);
  const Bytes stream = deflater.compressed(rows);
  ASSERT_FALSE(stream.empty());
  expectInflatesTo(rows, stream);
}

TEST(PixelDeflate, OneColourTakesNearlyNothing) {
  for (const std::size_t channels : {3U, 4U}) {
    const Bytes rows((1 + 1920 * channels) * 1080, 0);
    TestDeflater deflater(1920, channels);
    const Bytes stream = deflater.compressed(rows);
    expectInflatesTo(rows, stream);
    EXPECT_LT(stream.size(), 12000U);
  }
}

TEST(PixelDeflate, PicturesThatAreNotFlatAreLeftToOthers) {
  const Frame noise = test::noiseFrame(200, 100, 5);
  Bytes rows;
  for (std::size_t y = 0; y < 100; ++y) {
    rows.push_back(0);
    rows.insert(rows.end(), noise.rgba.begin() + static_cast<std::ptrdiff_t>(y * 800),
                noise.rgba.begin() + static_cast<std::ptrdiff_t>((y + 1) * 800));
  }
  TestDeflater deflater(200, 4);
  EXPECT_EQ(deflater.compressed(rows).size(), 0U);
  // … and nothing of them is left for the next picture.
  const Bytes flat(rows.size(), 0);
  expectInflatesTo(flat, deflater.compressed(flat));
}

TEST(PixelDeflate, ABufferThatIsTooSmallIsNotOverrun) {
  std::mt19937 random(4);
  const Bytes rows = flatRows(random, 300, 200, 3);
  TestDeflater deflater(300, 3);
  const Bytes whole = deflater.compressed(rows);
  ASSERT_FALSE(whole.empty());
  constexpr std::uint8_t kGuard = 0xA5;
  for (std::size_t size = 0; size < whole.size() + 1000; size += 97) {
    Bytes buffer(size + 64, kGuard);
    const std::size_t made = deflater.compress(rows, std::span(buffer).first(size));
    if (made > 0) {
      ASSERT_TRUE(Bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(made)) == whole);
    }
    if (size < whole.size()) {
      ASSERT_EQ(made, 0U) << size;
    }
    for (std::size_t i = size; i < buffer.size(); ++i) ASSERT_EQ(buffer[i], kGuard) << size;
  }
}

TEST(PixelDeflate, CirclesTakeNoMoreThanASearchOfTheWholeWindow) {
  const Frame frame = test::lectureFrame(1280, 720, 3);
  Bytes rows;
  for (std::size_t i = 0; i < frame.rgba.size(); i += 4) {
    if (i % (1280 * 4) == 0) rows.push_back(0);
    rows.insert(rows.end(), &frame.rgba[i], &frame.rgba[i] + 3);
  }
  TestDeflater deflater(1280, 3);
  const Bytes stream = deflater.compressed(rows);
  expectInflatesTo(rows, stream);
  libdeflate_compressor* other = libdeflate_alloc_compressor(2);
  Bytes reference(libdeflate_zlib_compress_bound(other, rows.size()));
  reference.resize(
      libdeflate_zlib_compress(other, rows.data(), rows.size(), reference.data(), reference.size()));
  libdeflate_free_compressor(other);
  EXPECT_LT(static_cast<double>(stream.size()), 1.1 * static_cast<double>(reference.size()));
}

} // namespace
} // namespace offstage
