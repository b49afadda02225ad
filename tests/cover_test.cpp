#include "render/draw/pen.h"
#include "render/raster/canvas.h"
#include "render/raster/cover.h"
#include "render/raster/tile_set.h"
#include "tests/support/canvas_pictures.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// A line, an arrow or a piece of a path between two points.
Primitive lineAt(const Vec2& from, const Vec2& to, int i) {
  Picture scratch;
  Pen pen(scratch, 0.4 + 0.02 * i, {0, 0, 0, 255});
  const std::array<Vec2, 3> points{from, Vec2(0.4 * from + 0.6 * to + Vec2(9.0, -4.0)), to};
  switch (i / 5 % 3) {
  case 0:
    pen.line(from, to);
    break;
  case 1:
    pen.arrow(from, to, 14.0);
    break;
  default:
    pen.path(points);
  }
  return scratch.primitives[static_cast<std::size_t>(i) % scratch.primitives.size()];
}

TEST(Cover, NoneAndWholeAreWhatTheCanvasPaints) {
  constexpr int kSide = 96;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-10.0, kSide + 10.0);
  std::uniform_real_distribution<double> exponent(std::log(0.1), std::log(300.0));
  Canvas canvas(kSide, kSide);
  Frame frame;
  int none = 0;
  int whole = 0;
  for (int i = 0; i < 400; ++i) {
    const double radius = std::exp(exponent(random));
    const Vec2 at(place(random), place(random));
    Primitive primitive = disc(at.x(), at.y(), radius, {0, 0, 0, 255});
    if (i % 4 == 1) primitive = ring(at.x(), at.y(), 0.7 * radius, radius, {0, 0, 0, 255});
    if (i % 4 == 2)
      primitive = box(at.x(), at.y(), at.x() + radius, at.y() + 0.4 * radius + 1.0, {0, 0, 0, 255});
    if (i % 4 == 3) {
      primitive = box(at.x(), at.y(), at.x() + radius, at.y() + radius, {0, 0, 0, 255});
      primitive.kind = Primitive::Kind::BoxRing;
      primitive.innerLow = primitive.low + Vec2(2.3, 2.3);
      primitive.innerHigh = primitive.high - Vec2(2.3, 2.3);
    }
    Picture picture = blankPicture(kSide, kSide);
    picture.primitives = {primitive};
    if (i % 5 == 0) picture.primitives = {lineAt(at, Vec2(place(random), place(random)), i)};
    primitive = picture.primitives.front();
    canvas.draw(picture, frame);
    const CoverTest test(primitive);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const Cover cover = test.of({x, y, x + 1, y + 1});
        const int painted = 255 - pixel(frame, x, y).r;
        none += cover == Cover::None ? 1 : 0;
        whole += cover == Cover::Whole ? 1 : 0;
        ASSERT_FALSE(cover == Cover::None && painted != 0)
            << painted << " of primitive " << i << " at " << x << ", " << y;
        ASSERT_FALSE(cover == Cover::Whole && painted != 255)
            << painted << " of primitive " << i << " at " << x << ", " << y;
      }
    }
  }
  EXPECT_GT(none, 1000);
  EXPECT_GT(whole, 1000);
}

TEST(TileSet, RunsAndSquaresHoldExactlyItsTiles) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    constexpr int kWidth = 333;
    constexpr int kHeight = 217;
    TileSet tiles(kWidth, kHeight);
    std::vector<std::vector<bool>> expected(28, std::vector<bool>(42));
    for (int i = 0; i < 20 + 30 * round; ++i) {
      const int x = static_cast<int>(random() % kWidth);
      const int y = static_cast<int>(random() % kHeight);
      tiles.addTile(x, y);
      expected[static_cast<std::size_t>(y / 8)][static_cast<std::size_t>(x / 8)] = true;
    }
    std::vector<std::vector<int>> seen(28, std::vector<int>(42));
    std::vector<PixelRect> squares;
    for (int row = 0; row < tiles.rows(); ++row)
      for (int column = 0; column < tiles.columns(); ++column)
        appendSquares(tiles.cell(column, row), column, row, squares);
    for (const PixelRect& square : squares) {
      EXPECT_EQ(square.right - square.left, square.bottom - square.top);
      EXPECT_EQ(square.left % (square.right - square.left), 0);
      for (int y = square.top; y < square.bottom; y += 8)
        for (int x = square.left; x < square.right; x += 8)
          ++seen.at(static_cast<std::size_t>(y / 8)).at(static_cast<std::size_t>(x / 8));
    }
    std::vector<PixelRect> runs;
    tiles.appendRuns(runs);
    for (std::size_t y = 0; y < expected.size(); ++y) {
      for (std::size_t x = 0; x < expected[y].size(); ++x) {
        EXPECT_EQ(seen[y][x], expected[y][x] ? 1 : 0) << "tile " << x << ", " << y;
        int covering = 0;
        for (const PixelRect& run : runs)
          covering += static_cast<int>(x) * 8 >= run.left && static_cast<int>(x) * 8 < run.right &&
                              static_cast<int>(y) * 8 >= run.top && static_cast<int>(y) * 8 < run.bottom
                          ? 1
                          : 0;
        EXPECT_LE(covering, 1);
        EXPECT_GE(covering, expected[y][x] ? 1 : 0) << "tile " << x << ", " << y;
      }
    }
    for (const PixelRect& run : runs) EXPECT_TRUE(run.right <= kWidth && run.bottom <= kHeight);
  }
}

TEST(TileSet, OneWholeCellIsOneSquareAndOneTileAway3) {
  std::vector<PixelRect> squares;
  appendSquares(TileSet::kWhole, 2, 1, squares);
  ASSERT_EQ(squares.size(), 1U);
  EXPECT_EQ(squares.front(), (PixelRect{128, 64, 192, 128}));
  squares.clear();
  appendSquares(TileSet::kWhole & ~std::uint64_t{1}, 0, 0, squares);
  EXPECT_EQ(squares.size(), 9U); // three of 32, three of 16, three of 8 px
}

} // namespace
} // namespace offstage::test
