#include "render/raster/canvas.h"
#include "src/sim/error.h"
#include "tests/support/allocation_count.h"
#include "tests/support/canvas_pictures.h"

#include <algorithm>
#include <limits>
#include <malloc.h>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

namespace offstage {

void PrintTo(const Rgba8& color, std::ostream* out) {
  *out << "rgba(" << int{color.r} << ", " << int{color.g} << ", " << int{color.b} << ", " << int{color.a}
       << ")";
}

namespace {

using namespace offstage::test;

constexpr Rgba8 kWhite{255, 255, 255, 255};
constexpr Rgba8 kBlack{0, 0, 0, 255};

TEST(Canvas, BackgroundIsExactForEveryByte) {
  Canvas canvas(3, 2);
  Frame frame;
  for (int value = 0; value < 256; ++value) {
    const auto byte = static_cast<std::uint8_t>(value);
    const Rgba8 color{byte, static_cast<std::uint8_t>(255 - value), byte, 255};
    canvas.draw(blankPicture(3, 2, color), frame);
    ASSERT_EQ(frame.rgba.size(), 24U);
    for (int x = 0; x < 3; ++x) EXPECT_EQ(pixel(frame, x, 1), color) << "value " << value;
  }
}

TEST(Canvas, OpaqueInteriorIsExactForEveryByteAndKind) {
  Canvas canvas(64, 64);
  Frame frame;
  for (int value = 0; value < 256; ++value) {
    const auto byte = static_cast<std::uint8_t>(value);
    const Rgba8 color{byte, static_cast<std::uint8_t>(255 - value), static_cast<std::uint8_t>(value ^ 85),
                      255};
    Picture picture = blankPicture(64, 64);
    picture.primitives = {disc(12.3, 12.7, 8.2, color), disc(40.5, 12.5, 3.0, color),
                          ring(30.0, 42.0, 8.0, 14.0, color), box(50.2, 30.1, 60.4, 60.9, color),
                          ring(8.5, 50.5, 1.0, 5.0, color)};
    canvas.draw(picture, frame);
    EXPECT_EQ(pixel(frame, 12, 12), color) << "disc";
    EXPECT_EQ(pixel(frame, 40, 12), color) << "small disc";
    EXPECT_EQ(pixel(frame, 30, 31), color) << "ring";
    EXPECT_EQ(pixel(frame, 30, 42), kWhite) << "hole of the ring";
    EXPECT_EQ(pixel(frame, 55, 45), color) << "box";
    EXPECT_EQ(pixel(frame, 5, 50), color) << "ring with a small hole";
    EXPECT_EQ(pixel(frame, 0, 0), kWhite) << "outside";
  }
}

TEST(Canvas, BoxesCoverPixelsByTheirExactArea) {
  Picture picture = blankPicture(40, 8);
  picture.primitives = {box(2.5, 2.0, 4.0, 4.0, kBlack),    // left column half
                        box(10.0, 2.25, 11.0, 2.5, kBlack), // a quarter of one pixel
                        box(20.5, 2.5, 21.5, 3.5, kBlack),  // four quarters
                        box(30.0, 2.0, 30.0, 5.0, kBlack)}; // no width
  const Frame frame = drawOnce(picture);
  EXPECT_NEAR(pixel(frame, 2, 2).r, 127.5, 0.5);
  EXPECT_EQ(pixel(frame, 3, 2), kBlack);
  EXPECT_EQ(pixel(frame, 4, 2), kWhite);
  EXPECT_EQ(pixel(frame, 3, 1), kWhite);
  EXPECT_EQ(pixel(frame, 3, 4), kWhite);
  EXPECT_NEAR(pixel(frame, 10, 2).r, 191.25, 0.75);
  for (const auto& [x, y] : {std::pair{20, 2}, {21, 2}, {20, 3}, {21, 3}}) {
    EXPECT_NEAR(pixel(frame, x, y).g, 191.25, 0.75) << x << ", " << y;
  }
  EXPECT_EQ(pixel(frame, 30, 3), kWhite);
}

TEST(Canvas, RowsRunDownwards) {
  Picture picture = blankPicture(4, 4);
  picture.primitives = {box(0.0, 0.0, 4.0, 1.0, kBlack)};
  const Frame frame = drawOnce(picture);
  EXPECT_EQ(pixel(frame, 0, 0), kBlack);
  EXPECT_EQ(pixel(frame, 0, 3), kWhite);
}

TEST(Canvas, LaterPrimitivesCoverEarlierOnesAcrossKindsAndPaints) {
  const auto image = std::make_shared<const Image>(Image{1, 1, {10, 200, 30, 255}});
  Picture picture = blankPicture(32, 32);
  const Rgba8 red{255, 0, 0, 255};
  const Rgba8 blue{0, 0, 255, 255};
  picture.primitives = {disc(16, 16, 14, red), box(8, 8, 24, 24, blue)};
  addPatternBox(picture, image, {12, 12}, {20, 20}, {8, 8}, false);
  picture.primitives.push_back(disc(16.5, 16.5, 2.0, red));
  picture.primitives.push_back(box(14, 16, 15, 17, blue));
  const Frame frame = drawOnce(picture);
  EXPECT_EQ(pixel(frame, 4, 16), red);
  EXPECT_EQ(pixel(frame, 9, 9), blue);
  EXPECT_EQ(pixel(frame, 13, 13), (Rgba8{10, 200, 30, 255}));
  EXPECT_EQ(pixel(frame, 16, 16), red);
  EXPECT_EQ(pixel(frame, 14, 16), blue);
}

TEST(Canvas, TranslucencyBlendsSrgbBytesAsTheyAre) {
  // JavaFX: floor((s*a + d*(255 - a))/255); the canvas rounds each product instead.
  Canvas canvas(2, 2);
  Frame frame;
  for (int alpha = 0; alpha < 256; alpha += 5) {
    for (int source = 0; source < 256; source += 15) {
      const Rgba8 color{static_cast<std::uint8_t>(source), 255, 0, static_cast<std::uint8_t>(alpha)};
      Picture picture = blankPicture(2, 2, {200, 100, 50, 255});
      picture.primitives = {box(0, 0, 2, 2, color)};
      canvas.draw(picture, frame);
      const auto blend = [&](int s, int d) { return (s * alpha + d * (255 - alpha)) / 255.0; };
      const Rgba8 result = pixel(frame, 1, 1);
      EXPECT_NEAR(result.r, blend(source, 200), 1.0) << "source " << source << " alpha " << alpha;
      EXPECT_NEAR(result.g, blend(255, 100), 1.0) << "alpha " << alpha;
      EXPECT_NEAR(result.b, blend(0, 50), 1.0) << "alpha " << alpha;
      EXPECT_EQ(result.a, 255);
    }
  }
}

TEST(Canvas, OpaqueBackgroundStaysOpaqueUnderAnyStack) {
  Picture picture = everythingPicture();
  const Frame frame = drawOnce(picture);
  for (std::size_t i = 3; i < frame.rgba.size(); i += 4) {
    ASSERT_EQ(frame.rgba[i], 255) << "pixel " << i / 4;
  }
}

TEST(Canvas, TransparentBackgroundGivesStraightAlpha) {
  Picture picture = blankPicture(16, 8, {0, 0, 0, 0});
  const Rgba8 opaque{12, 34, 56, 255};
  const Rgba8 half{200, 100, 50, 128};
  picture.primitives = {box(0, 0, 4, 4, opaque), box(8, 0, 12, 4, half), box(4.5, 0, 5.5, 4, opaque)};
  const Frame frame = drawOnce(picture);
  EXPECT_EQ(pixel(frame, 1, 1), opaque);
  EXPECT_EQ(pixel(frame, 15, 7), (Rgba8{0, 0, 0, 0}));
  const Rgba8 blended = pixel(frame, 9, 1);
  EXPECT_EQ(blended.a, 128);
  EXPECT_NEAR(blended.r, 200, 1); // one premultiplied step is 2 colour steps at this alpha
  EXPECT_NEAR(blended.g, 100, 1);
  EXPECT_NEAR(blended.b, 50, 1);
  const Rgba8 edge = pixel(frame, 4, 1);
  EXPECT_NEAR(edge.a, 127.5, 0.5);
  EXPECT_NEAR(edge.r, 12, 1);
  EXPECT_NEAR(edge.b, 56, 1);
}

TEST(Canvas, TranslucentBackgroundKeepsItsColour) {
  const Rgba8 background{100, 150, 200, 51};
  const Frame frame = drawOnce(blankPicture(2, 2, background));
  const Rgba8 result = pixel(frame, 0, 0);
  EXPECT_EQ(result.a, 51);
  EXPECT_NEAR(result.r, 100, 2.5); // 1/255 of premultiplied colour is 5 steps at this alpha
  EXPECT_NEAR(result.g, 150, 2.5);
  EXPECT_NEAR(result.b, 200, 2.5);
}

TEST(Canvas, WhatIsOutsideTheClipIsNotPainted) {
  Picture picture = blankPicture(20, 20);
  picture.clip = {5, 6, 15, 14};
  picture.primitives = {disc(10, 10, 30, kBlack), box(-5, -5, 40, 40, kBlack)};
  const Frame frame = drawOnce(picture);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool inside = x >= 5 && x < 15 && y >= 6 && y < 14;
      EXPECT_EQ(pixel(frame, x, y), inside ? kBlack : kWhite) << x << ", " << y;
    }
  }
}

TEST(Canvas, BadGeometryPaintsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const Frame blank = drawOnce(blankPicture(16, 16));
  for (const Primitive& bad :
       {disc(nan, 8, 4, kBlack), disc(8, nan, 4, kBlack), disc(8, 8, nan, kBlack),
        disc(8, 8, infinite, kBlack), disc(8, 8, -1, kBlack), disc(infinite, 8, 4, kBlack),
        disc(8, 8, 0, kBlack), box(nan, 0, 4, 4, kBlack), box(0, 0, 4, nan, kBlack), box(8, 8, 4, 4, kBlack),
        ring(8, 8, 5, 5, kBlack)}) {
    Picture picture = blankPicture(16, 16);
    picture.primitives = {bad};
    EXPECT_EQ(drawOnce(picture).rgba, blank.rgba) << "kind " << static_cast<int>(bad.kind) << " centre "
                                                  << bad.center.transpose() << " radius " << bad.outer;
  }
}

TEST(Canvas, GeometryBeyondAllMeasureCoversOrMisses) {
  for (const double huge : {1e9, 1e15, 1e100, 1e300}) {
    Picture picture = blankPicture(9, 7);
    picture.primitives = {disc(4.0, 3.0, huge, kBlack)};
    EXPECT_EQ(pixel(drawOnce(picture), 4, 3), kBlack) << "radius " << huge;
    picture.primitives = {box(-huge, -huge, huge, huge, kBlack)};
    EXPECT_EQ(pixel(drawOnce(picture), 0, 6), kBlack) << "box " << huge;
    picture.primitives = {disc(3.0 * huge, 0.0, huge, kBlack)};
    EXPECT_EQ(pixel(drawOnce(picture), 8, 3), kWhite) << "far away " << huge;
  }
}

TEST(Canvas, SmallestAndOddSizesWork) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {641, 479}, {3, 5000}}) {
    Picture picture = blankPicture(width, height, {1, 2, 3, 255});
    picture.primitives = {box(width - 1.0, height - 1.0, width, height, kWhite)};
    const Frame frame = drawOnce(picture);
    ASSERT_EQ(frame.width, width);
    ASSERT_EQ(frame.height, height);
    EXPECT_EQ(pixel(frame, width - 1, height - 1), kWhite) << width << "x" << height;
    if (width > 1) {
      EXPECT_EQ(pixel(frame, 0, height - 1), (Rgba8{1, 2, 3, 255})) << width << "x" << height;
    }
  }
}

TEST(Canvas, WidestCanvasPlacesThePixelsOfItsFarEnd) {
  Canvas canvas(16384, 2);
  EXPECT_EQ(canvas.info().maxSize, 16384);
  Picture picture = blankPicture(16384, 2);
  picture.primitives = {box(16382.0, 0, 16383.0, 1, kBlack), box(16383.5, 1, 16384, 2, kBlack)};
  Frame frame;
  canvas.draw(picture, frame);
  EXPECT_EQ(pixel(frame, 16381, 0), kWhite);
  EXPECT_EQ(pixel(frame, 16382, 0), kBlack);
  EXPECT_EQ(pixel(frame, 16383, 0), kWhite);
  EXPECT_NEAR(pixel(frame, 16383, 1).r, 127.5, 0.5);
}

TEST(Canvas, RefusesSizesThatItCannotDraw) {
  for (const auto& [width, height] : {std::pair{0, 4}, {4, 0}, {-1, 4}, {16385, 4}, {4, 1000000000}}) {
    try {
      const Canvas canvas(width, height);
      ADD_FAILURE() << width << "x" << height << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      EXPECT_NE(std::string(error.what()).find("1 to 16384"), std::string::npos) << error.what();
    }
  }
}

TEST(Canvas, RefusesAPictureOfAnotherSize) {
  Canvas canvas(8, 8);
  Frame frame;
  EXPECT_THROW(canvas.draw(blankPicture(8, 9), frame), Error);
}

TEST(Canvas, DrawsTheSameAgainAndOnAnotherCanvas) {
  const Picture everything = everythingPicture();
  Canvas first(everything.width, everything.height);
  Canvas small(8, 8);
  Frame frame;
  first.draw(everything, frame);
  const std::uint64_t hash = frame.hash();
  small.draw(blankPicture(8, 8), frame);
  first.draw(blankPicture(everything.width, everything.height), frame);
  first.draw(everything, frame);
  EXPECT_EQ(frame.hash(), hash) << "the same canvas, after others";
  EXPECT_EQ(drawOnce(everything).hash(), hash) << "another canvas beside it";
}

TEST(Canvas, NewContextAfterTheLastCanvasIsGone) {
  const std::uint64_t first = drawOnce(everythingPicture()).hash();
  const std::uint64_t second = drawOnce(everythingPicture()).hash();
  EXPECT_EQ(first, second);
}

TEST(Canvas, ManyPrimitivesKeepTheirOrder) {
  Picture picture = blankPicture(100, 10);
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 100;
    picture.primitives.push_back(
        i % 2 == 0 ? box(x, 0, x + 1.0, 10, {0, 0, 0, 255})
                   : box(x, 0, x + 1.0, 10, {static_cast<std::uint8_t>(i / 100), 9, 9, 255}));
  }
  const Frame frame = drawOnce(picture);
  EXPECT_EQ(pixel(frame, 98, 5), kBlack);
  EXPECT_EQ(pixel(frame, 99, 5), (Rgba8{199, 9, 9, 255}));
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kOwnAllocator = false; // AddressSanitizer counts for itself, and looks for leaks at the end
#else
constexpr bool kOwnAllocator = true;
#endif

/// Bytes that are allocated and not given back, GL's among them. Resident memory is no measure here: it goes
/// on settling for thousands of frames.
std::size_t allocatedMemory() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

TEST(Canvas, MemoryDoesNotGrowWithTheNumberOfFrames) {
  if (!kOwnAllocator) GTEST_SKIP() << "the sanitizer has its own allocator";
  Canvas canvas(333, 217);
  Frame frame;
  Picture picture = everythingPicture();
  const auto drawMoving = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      for (Primitive& primitive : picture.primitives) primitive.center.x() += i % 2 == 0 ? 3.3 : -3.3;
      canvas.draw(picture, frame);
    }
  };
  drawMoving(100);
  const std::size_t before = allocatedMemory();
  ASSERT_GT(before, 0U);
  std::string sizes = std::to_string(before);
  for (int stretch = 0; stretch < 4; ++stretch) {
    drawMoving(400);
    sizes += " -> " + std::to_string(allocatedMemory());
  }
  EXPECT_LT(allocatedMemory(), before + (64UL << 10U)) << "bytes after stretches of 400 frames: " << sizes;
}

TEST(Canvas, AllocatesNothingAfterWarmUp) {
  Canvas canvas(333, 217);
  Frame frame;
  Picture picture = everythingPicture();
  const auto drawFrames = [&](int frames, std::size_t moving) {
    for (int i = 0; i < frames; ++i) {
      for (std::size_t k = 0; k < moving; ++k) picture.primitives[k].center.x() += i % 2 == 0 ? 3.3 : -3.3;
      canvas.draw(picture, frame);
    }
  };
  for (const std::size_t moving : {picture.primitives.size(), std::size_t{3}, std::size_t{0}}) {
    drawFrames(10, moving);
    if (!allocationsSinceLastCall()) GTEST_SKIP() << "the sanitizer has its own allocator";
    drawFrames(50, moving);
    EXPECT_EQ(allocationsSinceLastCall(), 0U)
        << "operator new in 50 frames with " << moving << " moving primitives";
  }
}

TEST(Frame, HashDependsOnSizeAndPixels) {
  const Frame a{2, 1, {1, 2, 3, 4, 5, 6, 7, 8}};
  Frame b = a;
  EXPECT_EQ(a.hash(), b.hash());
  b.rgba[7] = 9;
  EXPECT_NE(a.hash(), b.hash());
  const Frame turned{1, 2, a.rgba};
  EXPECT_NE(a.hash(), turned.hash());
}

} // namespace
} // namespace offstage
