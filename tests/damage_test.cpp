#include "render/draw/pen.h"
#include "render/job/scene_source.h"
#include "render/raster/canvas.h"
#include "src/scene/scene.h"
#include "tests/support/canvas_pictures.h"
#include "tests/support/scene_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// The first pixel in which two frames differ, in words; empty when they are equal.
std::string firstDifference(const Frame& expected, const Frame& actual) {
  if (expected.width != actual.width || expected.height != actual.height) return "the sizes differ";
  const auto [a, b] = std::mismatch(expected.rgba.begin(), expected.rgba.end(), actual.rgba.begin());
  if (a == expected.rgba.end()) return "";
  const auto byte = static_cast<int>(a - expected.rgba.begin());
  return "at (" + std::to_string(byte / 4 % expected.width) + ", " +
         std::to_string(byte / 4 / expected.width) + "), channel " + std::to_string(byte % 4) +
         ": expected " + std::to_string(*a) + ", was " + std::to_string(*b);
}

/// A pixel outside of the frame's damage that differs from the frame before, in words; else empty.
std::string undamagedDifference(const Frame& before, const Frame& now) {
  std::vector<std::uint8_t> damaged(static_cast<std::size_t>(now.width) *
                                    static_cast<std::size_t>(now.height));
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(now.width) + static_cast<std::size_t>(x);
  };
  for (const PixelRect& rect : now.damage) {
    for (int y = rect.top; y < rect.bottom; ++y) {
      for (int x = rect.left; x < rect.right; ++x) {
        if (damaged.at(at(x, y)) != 0)
          return "damage overlaps at (" + std::to_string(x) + ", " + std::to_string(y) + ")";
        damaged.at(at(x, y)) = 1;
      }
    }
  }
  for (int y = 0; y < now.height; ++y)
    for (int x = 0; x < now.width; ++x)
      if (damaged[at(x, y)] == 0 &&
          !std::equal(before.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(at(x, y)),
                      before.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(at(x, y)) + 4,
                      now.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(at(x, y))))
        return "(" + std::to_string(x) + ", " + std::to_string(y) + ") changed outside of the damage";
  return "";
}

/// Draws the same pictures with damage tracking and as whole redraws, and compares them.
class BothWays {
public:
  BothWays(int width, int height) : tracking_(width, height), whole_(width, height) {}

  /// What is wrong with this picture's frame, or nothing.
  std::string draw(const Picture& picture) {
    const Frame before = tracked_;
    tracking_.draw(picture, tracked_);
    whole_.forget();
    whole_.draw(picture, expected_);
    std::string difference = firstDifference(expected_, tracked_);
    if (!difference.empty()) return difference;
    if (tracked_.base == 0) return "";
    ++partial_;
    if (tracked_.base != before.id) return "the damage does not refer to the frame before";
    return undamagedDifference(before, tracked_);
  }

  [[nodiscard]] int partial() const { return partial_; } ///< frames that were not drawn as a whole
  [[nodiscard]] const Frame& frame() const { return tracked_; }

private:
  Canvas tracking_;
  Canvas whole_;
  Frame tracked_;
  Frame expected_;
  int partial_ = 0;
};

class DamageOfScene : public ::testing::TestWithParam<std::string> {};

TEST_P(DamageOfScene, LeavesThePixelsOfAWholeRedraw) {
  const Scene scene = loadScene(OFFSTAGE_SOURCE_DIR "/scenes/" + GetParam() + ".toml", {});
  const Viewport viewport = Viewport::scaled(scene.size[0], scene.size[1], scene.scale);
  SceneSource source(scene, viewport);
  BothWays both(viewport.width, viewport.height);
  Picture picture;
  const auto frames = std::min<std::int64_t>(source.clock().steps(), 150);
  for (std::int64_t k = 0; k < frames; ++k) {
    source.draw(picture);
    ASSERT_EQ(both.draw(picture), "") << GetParam() << ", frame " << k;
    source.step();
  }
  // In a heap that is poured something moves almost everywhere.
  EXPECT_GT(both.partial(), GetParam() == "pile" ? frames / 5 : frames / 2) << "of " << frames << " frames";
}

INSTANTIATE_TEST_SUITE_P(Scenes, DamageOfScene, ::testing::ValuesIn(sceneNames()),
                         [](const auto& name) { return name.param; });

/// Random pictures that change a little from frame to frame.
class RandomShow {
public:
  RandomShow(unsigned seed, int width, int height, Rgba8 background)
      : random_(seed),
        picture_(blankPicture(width, height, background)),
        image_(colorfulImage(17, 11, false)) {
    for (const auto& [across, down] : {std::pair(9, 13), std::pair(40, 31), std::pair(1, 70)}) {
      Mask mask{across, down, {}};
      for (int k = 0; k < across * down; ++k) mask.coverage.push_back(static_cast<std::uint8_t>(below(256)));
      picture_.masks.push_back(std::make_shared<const Mask>(std::move(mask)));
    }
    picture_.clips = {{33, 21, 289, 350}, {211, 0, 517, 203}};
    for (int i = 0; i < 12; ++i) picture_.primitives.push_back(any());
  }

  const Picture& next() {
    for (Primitive& primitive : picture_.primitives)
      if (chance(0.3)) change(primitive);
    if (chance(0.2)) picture_.primitives.push_back(any());
    if (chance(0.2) && !picture_.primitives.empty()) {
      picture_.primitives.erase(picture_.primitives.begin() +
                                static_cast<std::ptrdiff_t>(below(picture_.primitives.size())));
    }
    return picture_;
  }

private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  Rgba8 color() {
    const auto byte = [&] { return static_cast<std::uint8_t>(below(256)); };
    return {byte(), byte(), byte(), chance(0.7) ? std::uint8_t{255} : byte()};
  }
  Vec2 place() { return {uniform(-20.0, picture_.width + 20.0), uniform(-20.0, picture_.height + 20.0)}; }

  Primitive any() {
    Primitive primitive = unclipped();
    if (chance(0.3)) primitive.clip = static_cast<std::int32_t>(below(picture_.clips.size()));
    return primitive;
  }

  /// A line, an arrow, or a piece out of the middle of a path.
  Primitive anyLine() {
    Picture scratch;
    Pen pen(scratch, uniform(0.3, 9.0), color());
    const Vec2 from = place();
    const Vec2 to = from + Vec2(uniform(-90.0, 90.0), uniform(-90.0, 90.0));
    if (chance(0.3)) {
      pen.arrow(from, to, uniform(5.0, 20.0));
    } else if (chance(0.3)) {
      pen.line(from, to);
    } else {
      const std::array<Vec2, 4> points{from, to, to + Vec2(uniform(-60.0, 60.0), 20.0), place()};
      pen.path(points);
    }
    return scratch.primitives.empty() ? disc(from.x(), from.y(), 3.0, color())
                                      : scratch.primitives[below(scratch.primitives.size())];
  }

  Primitive unclipped() {
    const Vec2 at = place();
    const double size = std::exp(uniform(std::log(0.3), std::log(120.0)));
    switch (below(7)) {
    case 2: {
      Primitive primitive = box(at.x(), at.y(), 0.0, 0.0, color());
      primitive.kind = Primitive::Kind::Mask;
      putMask(primitive);
      return primitive;
    }
    case 4:
    case 5:
      return anyLine();
    case 0:
      return ring(at.x(), at.y(), size * uniform(0.0, 1.0), size, color());
    case 1: {
      Primitive primitive = box(at.x(), at.y(), at.x() + size, at.y() + uniform(0.2, 90.0), color());
      if (chance(0.5)) {
        primitive.kind = Primitive::Kind::BoxRing;
        const double width = uniform(0.3, 5.0);
        primitive.innerLow = primitive.low + Vec2(width, width);
        primitive.innerHigh = primitive.high - Vec2(width, width);
      }
      return primitive;
    }
    default: {
      Primitive primitive = disc(at.x(), at.y(), size, color());
      if (chance(0.2)) {
        primitive.pattern = static_cast<std::int32_t>(picture_.patterns.size());
        picture_.patterns.push_back(
            {image_, at - Vec2(size, size), Vec2(2.0 * size, 2.0 * size), chance(0.5)});
      }
      return primitive;
    }
    }
  }

  /// Another mask, at whole pixels.
  void putMask(Primitive& primitive) {
    primitive.mask = static_cast<std::int32_t>(below(picture_.masks.size()));
    const Mask& mask = *picture_.masks[static_cast<std::size_t>(primitive.mask)];
    primitive.low = primitive.low.array().round();
    primitive.high = primitive.low + Vec2(mask.width, mask.height);
  }

  void change(Primitive& primitive) {
    if (chance(0.1)) primitive.color = color();
    if (chance(0.1)) primitive.outer *= uniform(0.9, 1.1);
    primitive.inner = std::min(primitive.inner, primitive.outer);
    const Vec2 moved =
        chance(0.1) ? Vec2(place() - primitive.center) : Vec2(uniform(-3.0, 3.0), uniform(-3.0, 3.0));
    primitive.center += moved;
    primitive.low += moved;
    primitive.high += moved;
    const bool cornersInside = primitive.kind <= Primitive::Kind::Quad; // of the others they are vectors
    for (Vec2* corner : {&primitive.innerLow, &primitive.innerHigh})
      if (cornersInside) *corner += moved;
    if (primitive.kind == Primitive::Kind::Mask) putMask(primitive);
  }

  std::mt19937 random_;
  Picture picture_;
  std::shared_ptr<const Image> image_;
};

TEST(Damage, OfRandomPicturesLeavesThePixelsOfAWholeRedraw) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Rgba8 backgrounds[] = {{255, 255, 255, 255}, {12, 130, 201, 255}, {90, 10, 250, 77}, {0, 0, 0, 0}};
    const int width = 517 + static_cast<int>(seed);
    const int height = 403 - static_cast<int>(seed);
    RandomShow show(seed, width, height, backgrounds[seed % 4]);
    BothWays both(width, height);
    for (int k = 0; k < 60; ++k) {
      ASSERT_EQ(both.draw(show.next()), "") << "seed " << seed << ", frame " << k;
    }
    EXPECT_GT(both.partial(), 10) << "of 60 frames with seed " << seed;
  }
}

TEST(Damage, OfManyDiscsOnEveryBackgroundLeavesThePixelsOfAWholeRedraw) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int shade = 0; shade < 256; shade += 5) {
    const auto byte = [&](int offset) { return static_cast<std::uint8_t>((shade + offset) % 256); };
    Picture picture = blankPicture(640, 480, {byte(0), byte(85), byte(170), 255});
    for (int i = 0; i < 16; ++i) {
      const int row = i / 4;
      picture.primitives.push_back(disc(i % 4 * 150 + 80, row * 110 + 50, 6.0 + 24.0 * unit(random),
                                        {byte(3 * i), byte(7 * i), byte(11 * i), 255}));
    }
    BothWays both(640, 480);
    for (int k = 0; k < 6; ++k) {
      ASSERT_EQ(both.draw(picture), "") << "shade " << shade << ", frame " << k;
      for (Primitive& primitive : picture.primitives)
        primitive.center += Vec2(unit(random), unit(random) - 0.5);
    }
    EXPECT_GE(both.partial(), 4) << "of 6 frames";
  }
}

TEST(Damage, InsideAClipLeavesThePixelsOfAWholeRedraw) {
  Picture picture = blankPicture(300, 200, {240, 240, 250, 255});
  picture.clip = {37, 21, 251, 183};
  picture.primitives = {disc(60.0, 60.0, 50.0, {200, 30, 30, 255}),
                        disc(220.0, 150.0, 60.0, {30, 30, 200, 255})};
  BothWays both(300, 200);
  for (int k = 0; k < 40; ++k) {
    ASSERT_EQ(both.draw(picture), "") << "frame " << k;
    for (Primitive& primitive : picture.primitives) primitive.center += Vec2(1.7, -0.9);
  }
  EXPECT_GT(both.partial(), 20);
}

TEST(Damage, IsNothingWhenThePictureStandsStill) {
  BothWays both(517, 403);
  const Picture picture = RandomShow(5, 517, 403, {255, 255, 255, 255}).next();
  ASSERT_EQ(both.draw(picture), "");
  const std::uint64_t first = both.frame().id;
  ASSERT_EQ(both.draw(picture), "");
  EXPECT_TRUE(both.frame().damage.empty());
  EXPECT_EQ(both.frame().base, first);
  EXPECT_NE(both.frame().id, first);
}

TEST(Damage, KeepsOutOfTheInsideOfAPlainBody) {
  Picture picture = blankPicture(640, 480);
  picture.primitives = {disc(320.0, 240.0, 150.0, {10, 20, 30, 255})};
  Canvas canvas(640, 480);
  Frame frame;
  canvas.draw(picture, frame);
  picture.primitives.front().center.x() += 1.0;
  canvas.draw(picture, frame);
  ASSERT_NE(frame.base, 0U);
  for (const PixelRect& rect : frame.damage) {
    EXPECT_FALSE(rect.left <= 320 && rect.right > 320 && rect.top <= 240 && rect.bottom > 240)
        << rect.left << ' ' << rect.top << ' ' << rect.right << ' ' << rect.bottom;
  }
}

TEST(Damage, ChangesBelowAPlainBodyAreNotSeen) {
  Picture picture = blankPicture(640, 480);
  picture.primitives = {disc(320.0, 240.0, 20.0, {200, 20, 30, 255}),
                        disc(320.0, 240.0, 150.0, {10, 20, 30, 255})};
  Canvas canvas(640, 480);
  Frame frame;
  canvas.draw(picture, frame);
  picture.primitives.front().center.x() += 30.0;
  canvas.draw(picture, frame);
  ASSERT_NE(frame.base, 0U);
  EXPECT_TRUE(frame.damage.empty());
}

/// Pieces of straight paths that grow at one end and shrink at the other, as trails of bodies without
/// acceleration do: only their ends change.
TEST(Damage, OfALineThatGrowsIsWhatHasGrown) {
  constexpr double kFaster = 1.5; // than its beginning, the line's end
  for (int k = 0; k < 24; ++k) {
    const double turn = 0.26 * k + 0.013;
    const Vec2 ahead(std::cos(turn), std::sin(turn));
    const Vec2 start = Vec2(330.0, 250.0) - 150.0 * ahead;
    const double width = 0.7 + 0.5 * k;
    BothWays both(660, 500);
    std::int64_t damaged = 0;
    for (int frame = 0; frame < 30; ++frame) {
      Picture picture = blankPicture(660, 500, {245, 240, 230, 255});
      const std::array<Vec2, 2> points{start + 2.0 * frame * ahead,
                                       start + (180.0 + kFaster * 2.0 * frame) * ahead};
      Pen(picture, width, {20, 90, 200, static_cast<std::uint8_t>(k % 2 == 0 ? 255 : 140)})
          .path(points, {}, {.roundFirst = k % 3 == 0, .roundLast = false});
      ASSERT_EQ(both.draw(picture), "") << "direction " << k << ", frame " << frame;
      if (frame == 0) continue;
      ASSERT_NE(both.frame().base, 0U);
      for (const PixelRect& rect : both.frame().damage)
        damaged += std::int64_t{rect.right - rect.left} * (rect.bottom - rect.top);
    }
    // Without this the whole line: at least 150 px by its width and a tile.
    const double most = 2.0 * std::pow(2.0 * width + 34.0, 2.0);
    EXPECT_LT(static_cast<double>(damaged) / 29.0, most) << "px a frame, direction " << k;
  }
}

TEST(Damage, AnotherFrameObjectGetsAllPixels) {
  Picture picture = blankPicture(640, 480);
  picture.primitives = {disc(20.0, 20.0, 9.0, {10, 20, 30, 255})};
  Canvas canvas(640, 480);
  Frame first;
  canvas.draw(picture, first);
  picture.primitives.front().center.x() += 1.0;
  Frame second;
  canvas.draw(picture, second);
  EXPECT_EQ(firstDifference(drawOnce(picture), second), "");
  EXPECT_EQ(second.base, first.id);
}

TEST(Damage, AChangedBackgroundIsAWholeRedraw) {
  Picture picture = blankPicture(64, 48);
  Canvas canvas(64, 48);
  Frame frame;
  canvas.draw(picture, frame);
  picture.background = {1, 2, 3, 255};
  canvas.draw(picture, frame);
  EXPECT_EQ(frame.base, 0U);
  EXPECT_EQ(firstDifference(drawOnce(picture), frame), "");
}

} // namespace
} // namespace offstage::test
