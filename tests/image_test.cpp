#include "render/draw/image.h"
#include "src/scene/diagnostic.h"
#include "src/sim/error.h"
#include "tests/support/temp_dir.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using offstage::test::readFile;
using offstage::test::TempDir;
using offstage::test::writeFile;

const std::filesystem::path kAssets = OFFSTAGE_SOURCE_DIR "/tests/reference/stills/assets";

const std::filesystem::path kJpeg = OFFSTAGE_SOURCE_DIR "/tests/reference/images/gradient.jpg";

using Texel = std::array<int, 4>;

Texel texel(const Image& image, int x, int y) {
  const std::size_t at = 4UL * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(x));
  return {image.rgba.at(at), image.rgba.at(at + 1), image.rgba.at(at + 2), image.rgba.at(at + 3)};
}

/// A BMP of 24 bits, rows bottom-up as the format has them. `claim*` are the sizes written into its header.
std::string bmp(int width, int height, int claimWidth, int claimHeight) {
  const auto little = [](std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255U);
    return text;
  };
  const int stride = (width * 3 + 3) / 4 * 4;
  std::string file =
      "BM" + little(static_cast<std::uint32_t>(54 + stride * height), 4) + little(0, 4) + little(54, 4);
  file += little(40, 4) + little(static_cast<std::uint32_t>(claimWidth), 4) +
          little(static_cast<std::uint32_t>(claimHeight), 4) + little(1, 2) + little(24, 2) + little(0, 8) +
          little(0, 8) + little(0, 8);
  for (int y = height - 1; y >= 0; --y) {
    std::string row;
    for (int x = 0; x < width; ++x)
      row += little(static_cast<std::uint32_t>(x * 10 + (y << 8) + 0x500000), 3);
    row.resize(static_cast<std::size_t>(stride));
    file += row;
  }
  return file;
}

/// The message of the error that loading gives.
std::string errorOf(const std::filesystem::path& file, const SourceLocation& where = {}) {
  try {
    loadImage(file, where);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput) << error.what();
    return error.what();
  }
  return "no error";
}

TEST(Image, ReadsPngWithAndWithoutAlpha) {
  const Image quad = loadImage(kAssets / "quad.png");
  ASSERT_EQ(quad.width, 2);
  ASSERT_EQ(quad.height, 2);
  EXPECT_EQ(texel(quad, 0, 0), (Texel{255, 0, 0, 255}));
  EXPECT_EQ(texel(quad, 1, 0), (Texel{0, 255, 0, 255}));
  EXPECT_EQ(texel(quad, 0, 1), (Texel{0, 0, 255, 255}));
  const Image alpha = loadImage(kAssets / "alpha.png");
  EXPECT_EQ(alpha.width, 64);
  EXPECT_EQ(alpha.height, 48);
  bool translucent = false;
  for (std::size_t i = 3; i < alpha.rgba.size(); i += 4) translucent = translucent || alpha.rgba[i] < 255;
  EXPECT_TRUE(translucent);
}

TEST(Image, ReadsBmpTopDown) {
  const TempDir folder;
  writeFile(folder / "a.bmp", bmp(3, 2, 3, 2));
  const Image image = loadImage(folder / "a.bmp");
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(texel(image, 2, 0), (Texel{0x50, 0, 20, 255}));
  EXPECT_EQ(texel(image, 0, 1), (Texel{0x50, 1, 0, 255}));
}

TEST(Image, ReadsJpeg) {
  const Image image = loadImage(kJpeg); // red = 16 x, green = 32 y, blue = 200
  ASSERT_EQ(image.width, 16);
  ASSERT_EQ(image.height, 8);
  for (const auto& [x, y] : {std::pair{2, 1}, {13, 1}, {7, 6}}) {
    const Texel color = texel(image, x, y);
    EXPECT_NEAR(color[0], 16 * x, 12) << x << ", " << y;
    EXPECT_NEAR(color[1], 32 * y, 12) << x << ", " << y;
    EXPECT_NEAR(color[2], 200, 12) << x << ", " << y;
    EXPECT_EQ(color[3], 255);
  }
}

/// The smallest PNG of a colour type: one pixel, its samples given; checksums and compression are stored
/// plainly.
std::string onePixelPng(int depth, int colorType, const std::string& samples,
                        const std::string& palette = {}) {
  const auto big = [](std::uint32_t value) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 255U);
    return text;
  };
  const auto chunk = [&](const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffU; // ISO 3309, bit by bit
    for (const char c : type + data) {
      crc ^= static_cast<std::uint8_t>(c);
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
    }
    return big(static_cast<std::uint32_t>(data.size())) + type + data + big(~crc);
  };
  const std::string row = std::string(1, '\0') + samples; // filter "none"
  const auto size = static_cast<std::uint8_t>(row.size());
  std::uint32_t low = 1;
  std::uint32_t high = 0;
  for (const char c : row) { // Adler-32
    low = (low + static_cast<std::uint8_t>(c)) % 65521U;
    high = (high + low) % 65521U;
  }
  const std::string stored = std::string("\x78\x01\x01", 3) + static_cast<char>(size) + '\0' +
                             static_cast<char>(~size) + '\xff' + row + big(high << 16U | low);
  std::string header = big(1) + big(1) + static_cast<char>(depth) + static_cast<char>(colorType);
  header += std::string(3, '\0');
  std::string file = "\x89PNG\r\n\x1a\n" + chunk("IHDR", header);
  if (!palette.empty()) file += chunk("PLTE", palette);
  return file + chunk("IDAT", stored) + chunk("IEND", "");
}

TEST(Image, EveryKindOfPngBecomesRgbaOf8Bits) {
  const TempDir folder;
  const auto pixelOf = [&](const std::string& png) {
    writeFile(folder / "one.png", png);
    return texel(loadImage(folder / "one.png"), 0, 0);
  };
  EXPECT_EQ(pixelOf(onePixelPng(8, 0, "\x7b")), (Texel{123, 123, 123, 255})) << "grey";
  EXPECT_EQ(pixelOf(onePixelPng(1, 0, "\x80")), (Texel{255, 255, 255, 255})) << "one bit";
  EXPECT_EQ(pixelOf(onePixelPng(8, 4, "\x7b\x40")), (Texel{123, 123, 123, 64})) << "grey and alpha";
  EXPECT_EQ(pixelOf(onePixelPng(8, 2, "\x01\x02\x03")), (Texel{1, 2, 3, 255})) << "RGB";
  EXPECT_EQ(pixelOf(onePixelPng(8, 6, "\x01\x02\x03\x04")), (Texel{1, 2, 3, 4})) << "RGBA";
  EXPECT_EQ(pixelOf(onePixelPng(16, 2, std::string("\x12\x34\x56\x78\x9a\xbc", 6))),
            (Texel{0x12, 0x56, 0x9a, 255}))
      << "16 bits";
  EXPECT_EQ(pixelOf(onePixelPng(8, 3, "\x01", std::string("\x00\x00\x00\x0a\x14\x1e", 6))),
            (Texel{10, 20, 30, 255}))
      << "palette";
}

TEST(Image, MissingFilesFoldersAndOtherThingsAreNamed) {
  const TempDir folder;
  EXPECT_EQ(errorOf(folder / "none.png"),
            "image '" + (folder / "none.png").string() + "': No such file or directory");
  EXPECT_EQ(errorOf(folder.path()), "image '" + folder.path().string() + "': is a folder");
  writeFile(folder / "empty.png", "");
  EXPECT_EQ(errorOf(folder / "empty.png"), "image '" + (folder / "empty.png").string() + "': is empty");
  writeFile(folder / "text.png", "this is no picture");
  EXPECT_EQ(errorOf(folder / "text.png"), "image '" + (folder / "text.png").string() +
                                              "': cannot be read as PNG, JPEG or BMP (unknown image type)");
}

TEST(Image, ErrorsAreLocatedWhenTheKeyIsKnown) {
  try {
    loadImage("none.png", {"scene.toml", 12, 10});
    FAIL() << "no error";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1U);
    EXPECT_STREQ(error.what(), "scene.toml:12:10: error: image 'none.png': No such file or directory");
  }
}

TEST(Image, SizeIsCheckedBeforeMemoryIsTaken) {
  const TempDir folder;
  writeFile(folder / "wide.bmp", bmp(1, 1, 16385, 1));
  EXPECT_NE(errorOf(folder / "wide.bmp").find("each side may be 1 to 16384"), std::string::npos)
      << errorOf(folder / "wide.bmp");
  writeFile(folder / "huge.bmp", bmp(1, 1, 2000000000, 2000000000));
  EXPECT_NE(errorOf(folder / "huge.bmp"), "no error");
  writeFile(folder / "claim.bmp", bmp(1, 1, 16384, 16384));
  EXPECT_NE(errorOf(folder / "claim.bmp").find("too short for 16384x16384 px"), std::string::npos)
      << errorOf(folder / "claim.bmp");
  writeFile(folder / "none.bmp", bmp(1, 1, 0, 0));
  EXPECT_NE(errorOf(folder / "none.bmp"), "no error");
}

TEST(Image, JpegTablesWithTooManyCodesAreRefused) {
  // stb_image 2.27 writes past its table of 256 codes.
  const TempDir folder;
  std::string file = readFile(kJpeg);
  const std::size_t table = file.find("\xff\xc4");
  ASSERT_NE(table, std::string::npos);
  for (std::size_t length = 0; length < 16; ++length) file.at(table + 5 + length) = '\x11'; // 16·17 codes
  for (const char* fillBytes : {"", "\xff", "\xff\xff\xff"}) { // before the first marker
    writeFile(folder / "codes.jpg", fillBytes + file);
    EXPECT_NE(errorOf(folder / "codes.jpg").find("a Huffman table with more than 256 codes"),
              std::string::npos)
        << errorOf(folder / "codes.jpg");
  }
}

TEST(Image, TruncatedAndFlippedFilesNeverCrash) {
  const TempDir folder;
  const std::filesystem::path damaged = folder / "damaged";
  std::mt19937 random(1);
  int refused = 0;
  const auto tryLoading = [&](const std::string& bytes) {
    writeFile(damaged, bytes);
    try {
      const Image image = loadImage(damaged);
      EXPECT_EQ(image.rgba.size(),
                4UL * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      ++refused;
    }
  };
  for (const std::string& whole :
       {readFile(kAssets / "alpha.png"), readFile(kAssets / "quad.png"), readFile(kJpeg), bmp(9, 7, 9, 7)}) {
    for (int i = 0; i < 60; ++i) {
      tryLoading(whole.substr(0, random() % whole.size()));
      std::string flipped = whole;
      for (int flips = 0; flips < 3; ++flips) {
        flipped[random() % flipped.size()] ^= static_cast<char>(1U << random() % 8U);
      }
      tryLoading(flipped);
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(ImageCache, DecodesEachFileOnce) {
  ImageCache cache;
  ImagePattern pattern;
  pattern.file = kAssets / "quad.png";
  const auto first = cache.get(pattern);
  pattern.anchor = {1, 2, 3, 4};
  EXPECT_EQ(cache.get(pattern), first);
  pattern.file = kAssets / "alpha.png";
  EXPECT_NE(cache.get(pattern), first);
}

} // namespace
} // namespace offstage
