#include "render/draw/pen.h"
#include "render/raster/canvas.h"
#include "tests/support/canvas_pictures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr int kSide = 40;
constexpr Rgba8 kBlack{0, 0, 0, 255};

using Inside = std::function<bool(const Vec2&)>;

/// The part of a pixel in which `inside` holds, by 64×64 samples, each row and column shifted by the golden
/// ratio so that no straight edge lies along them. Error below about 1/255.
double sampled(int x, int y, const Inside& inside) {
  constexpr int kSamples = 64;
  const auto at = [&](double i, double j) {
    constexpr double kGolden = 0.6180339887498949;
    const double right = i * kGolden - std::floor(i * kGolden);
    const double down = j * kGolden - std::floor(j * kGolden);
    return inside(Vec2(x + (i + down) / kSamples, y + (j + right) / kSamples));
  };
  // What is in the pixel crosses its border, or fills it.
  int border = 0;
  constexpr int kBorder = 40;
  for (int k = 0; k < kBorder; ++k) {
    const double t = static_cast<double>(k) / kBorder;
    for (const Vec2& p :
         {Vec2(x + t, y), Vec2(x + 1.0, y + t), Vec2(x + 1.0 - t, y + 1.0), Vec2(x, y + 1.0 - t)})
      border += inside(p) ? 1 : 0;
  }
  if (border == 0) return 0.0;
  if (border == 4 * kBorder) return 1.0;
  int sum = 0;
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i) sum += at(i, j) ? 1 : 0;
  return static_cast<double>(sum) / (kSamples * kSamples);
}

double distanceTo(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double whole = along.squaredNorm();
  const double part = whole > 0.0 ? std::clamp((p - a).dot(along) / whole, 0.0, 1.0) : 0.0;
  return (a + along * part - p).norm();
}

/// Draws `picture` (black on white) and returns how far its worst pixel is from the exact area, in 1/255.
double worst(const Picture& picture, const Inside& inside) {
  const Frame frame = drawOnce(picture);
  double most = 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      most = std::max(most, std::abs(pixel(frame, x, y).r - 255.0 * (1.0 - sampled(x, y, inside))));
  return most;
}

class RandomLines {
public:
  explicit RandomLines(unsigned seed) : random_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec2 point() { return {uniform(-6.0, kSide + 6.0), uniform(-6.0, kSide + 6.0)}; }

private:
  std::mt19937 random_;
};

TEST(CanvasLines, StraightOnesAreWithinOnePercentOfTheirArea) {
  RandomLines random(4);
  for (int i = 0; i < 60; ++i) {
    Vec2 from = random.point();
    Vec2 to = random.point();
    if (i % 10 == 0) to.y() = from.y();
    if (i % 10 == 5) to.x() = from.x() + 0.003;
    const double half = 0.5 * random.uniform(0.2, 9.0);
    Picture picture = blankPicture(kSide, kSide);
    Pen(picture, 2.0 * half, kBlack).line(from, to);
    const Vec2 along = (to - from) / length(to - from);
    const Vec2 aside(-along.y(), along.x());
    const double error = worst(picture, [&](const Vec2& p) {
      const double t = along.dot(p - from);
      return t > 0.0 && t < length(to - from) && std::abs(aside.dot(p - from)) < half;
    });
    EXPECT_LE(error, 2.55) << i << ": (" << from.transpose() << ") to (" << to.transpose() << "), half width "
                           << half;
  }
}

TEST(CanvasLines, RoundOnesAreWithinOnePercentOfTheirArea) {
  RandomLines random(5);
  for (int i = 0; i < 60; ++i) {
    const std::array<Vec2, 2> points{random.point(), random.point()};
    const double half = 0.5 * random.uniform(0.4, 9.0);
    Picture picture = blankPicture(kSide, kSide);
    Pen(picture, 2.0 * half, kBlack).path(points);
    const double error =
        worst(picture, [&](const Vec2& p) { return distanceTo(p, points[0], points[1]) < half; });
    EXPECT_LE(error, 2.55) << i << ": (" << points[0].transpose() << ") to (" << points[1].transpose()
                           << "), half width " << half;
  }
}

TEST(CanvasLines, ArrowsAreWithinOnePercentOfTheirArea) {
  RandomLines random(6);
  for (int i = 0; i < 60; ++i) {
    const Vec2 from = random.point();
    const Vec2 to = random.point();
    const double half = 0.5 * random.uniform(0.5, 4.0);
    const double head = std::min(random.uniform(4.0, 15.0), length(to - from));
    Picture picture = blankPicture(kSide, kSide);
    Pen(picture, 2.0 * half, kBlack).arrow(from, to, head);
    const Vec2 along = (to - from) / length(to - from);
    const Vec2 aside(-along.y(), along.x());
    const double error = worst(picture, [&](const Vec2& p) {
      const double left = length(to - from) - along.dot(p - from); // before the tip
      const double off = std::abs(aside.dot(p - from));
      if (left < 0.0 || left > length(to - from)) return false;
      return left <= head ? off < std::max(0.5 * head, half) * left / head : off < half;
    });
    EXPECT_LE(error, 2.55) << i << ": (" << from.transpose() << ") to (" << to.transpose() << "), half width "
                           << half << ", head " << head;
  }
}

/// A path's corner is drawn in sixteen columns; an edge that is nearly at right angles to them may be off by
/// half a column, 8/255.
TEST(CanvasLines, CornersOfPathsAreTheUnionOfTheirArms) {
  RandomLines random(7);
  double most = 0.0;
  for (int i = 0; i < 80; ++i) {
    const Vec2 corner(random.uniform(15.0, 25.0), random.uniform(15.0, 25.0));
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double angle = random.uniform(0.5, 2.9); // between the arms
    const double half = 0.5 * random.uniform(1.0, 6.0);
    const std::array<Vec2, 3> points{corner + Vec2(std::cos(turn), std::sin(turn)) * 30.0, corner,
                                     corner + Vec2(std::cos(turn + angle), std::sin(turn + angle)) * 30.0};
    Picture picture = blankPicture(kSide, kSide);
    Pen(picture, 2.0 * half, kBlack).path(points);
    const double error = worst(picture, [&](const Vec2& p) {
      return std::min(distanceTo(p, points[0], points[1]), distanceTo(p, points[1], points[2])) < half;
    });
    most = std::max(most, error);
    EXPECT_LE(error, 8.5) << i << ": corner (" << corner.transpose() << "), turned by " << turn << ", angle "
                          << angle << ", half width " << half;
  }
  RecordProperty("worst", std::to_string(most));
}

/// A translucent path has one shade inside, wherever its pieces meet: none is drawn twice, none is left out.
TEST(CanvasLines, TranslucentPathsAreEvenAcrossTheirPieces) {
  RandomLines random(8);
  for (int i = 0; i < 40; ++i) {
    std::vector<Vec2> points;
    const double radius = random.uniform(30.0, 90.0);
    const double step = random.uniform(0.02, 0.4); // up to 23° a piece: smooth and sharp corners
    const Vec2 center = Vec2(20.0, 20.0) - Vec2(radius, 0.0);
    for (int piece = 0; piece * step < 5.6; ++piece) { // not once around: it must not cross itself
      const double turn = -2.8 + piece * step;
      points.emplace_back(center + radius * Vec2(std::cos(turn), std::sin(turn)));
    }
    const double width = random.uniform(3.0, 9.0);
    Picture picture = blankPicture(kSide, kSide);
    Pen(picture, width, {0, 0, 0, 100}).path(points);
    const Frame frame = drawOnce(picture);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        double nearest = 1e9;
        for (std::size_t k = 1; k < points.size(); ++k)
          nearest = std::min(nearest, distanceTo(Vec2(x + 0.5, y + 0.5), points[k - 1], points[k]));
        const int value = pixel(frame, x, y).r;
        if (nearest < 0.5 * width - 0.75) {
          ASSERT_NEAR(value, 155, 1) << "path " << i << " at " << x << ", " << y;
        } else {
          ASSERT_GE(value, 154) << "path " << i << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(CanvasLines, AreNotPaintedBeyondTheirClip) {
  Picture picture = blankPicture(kSide, kSide);
  picture.clips = {{10, 12, 30, 25}};
  Pen pen(picture, 30.0, kBlack, 0);
  pen.line({0.0, 0.0}, {40.0, 37.0});
  pen.disc({20.0, 20.0}, 40.0);
  const Frame frame = drawOnce(picture);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      ASSERT_EQ(pixel(frame, x, y).r, x >= 10 && x < 30 && y >= 12 && y < 25 ? 0 : 255) << x << ", " << y;
}

TEST(CanvasLines, BadGeometryPaintsNothing) {
  Picture picture = blankPicture(kSide, kSide);
  Pen pen(picture, 3.0, kBlack);
  const double nan = std::nan("");
  const std::array<Vec2, 3> broken{Vec2(nan, 3.0), Vec2(5.0, INFINITY), Vec2(1e9, 2.0)};
  pen.path(broken);
  pen.line({nan, 1.0}, {3.0, 4.0});
  pen.arrow({1.0, 1.0}, {INFINITY, 4.0}, 5.0);
  pen.line({5.0, 5.0}, {5.0, 5.0});
  const std::array<Vec2, 1> single{Vec2(5.0, 5.0)};
  pen.path(single);
  pen.circle({1.0, 1.0}, nan);
  EXPECT_TRUE(picture.primitives.empty()) << picture.primitives.size();
}

} // namespace
} // namespace offstage::test
