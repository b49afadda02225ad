#include "render/raster/canvas.h"
#include "tests/support/canvas_pictures.h"
#include "tests/support/exact_coverage.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using namespace offstage::test;

/// The worst difference of black circles on white from their exact area, in 1/255.
struct Deviation {
  double worst = 0.0;
  int x = 0, y = 0;
  Vec2 center = Vec2::Zero();
  double outer = 0.0, inner = 0.0;

  void add(const Frame& frame, const Primitive& circle) {
    for (int row = 0; row < frame.height; ++row) {
      for (int column = 0; column < frame.width; ++column) {
        const auto part = [&](double radius) {
          return radius > 0.0 ? exactDiscCoverage(column, row, circle.center.x(), circle.center.y(), radius)
                              : 0.0;
        };
        const double exact = 255.0 * (1.0 - part(circle.outer) + part(circle.inner));
        const double difference = std::abs(pixel(frame, column, row).r - exact);
        if (difference <= worst) continue;
        *this = {difference, column, row, circle.center, circle.outer, circle.inner};
      }
    }
  }
};

std::ostream& operator<<(std::ostream& out, const Deviation& deviation) {
  return out << deviation.worst << "/255 at pixel (" << deviation.x << ", " << deviation.y
             << ") of the circle (" << deviation.center.transpose() << ") of radius " << deviation.inner
             << " to " << deviation.outer;
}

constexpr int kSide = 40;
constexpr Rgba8 kBlack{0, 0, 0, 255};

/// A circle whose edge passes within half a pixel of a random point of the canvas, seen in a random
/// direction.
Primitive circleThroughCanvas(std::mt19937& random, double radius) {
  std::uniform_real_distribution<double> inside(0.0, kSide);
  std::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi);
  const double angle = turn(random);
  return disc(inside(random) - radius * std::cos(angle), inside(random) - radius * std::sin(angle), radius,
              kBlack);
}

Deviation worstDisc(double lowest, double highest, int count) {
  std::mt19937 random(2022);
  std::uniform_real_distribution<double> exponent(std::log(lowest), std::log(highest));
  Canvas canvas(kSide, kSide);
  Frame frame;
  Deviation deviation;
  for (int i = 0; i < count; ++i) {
    Picture picture = blankPicture(kSide, kSide);
    picture.primitives = {circleThroughCanvas(random, std::exp(exponent(random)))};
    canvas.draw(picture, frame);
    deviation.add(frame, picture.primitives.front());
  }
  return deviation;
}

TEST(CanvasCoverage, DiscsUpToThousandPixelsAreWithinOnePercent) {
  for (const auto& [low, high] : {std::pair{0.1, 1.0}, {1.0, 4.0}, {4.0, 8.0}, {8.0, 50.0}, {50.0, 1000.0}}) {
    const Deviation deviation = worstDisc(low, high, 150);
    EXPECT_LE(deviation.worst, 2.55) << deviation;
    RecordProperty("worst_to_" + std::to_string(static_cast<int>(high)), std::to_string(deviation.worst));
  }
}

TEST(CanvasCoverage, HugeDiscsAreWithinOnePercent) {
  for (const auto& [low, high] : {std::pair{1e3, 1e5}, {1e5, 1e6}, {1e6, 1e9}}) {
    const Deviation deviation = worstDisc(low, high, 100);
    EXPECT_LE(deviation.worst, 2.55) << deviation;
  }
}

TEST(CanvasCoverage, EdgesAreAsExactAtTheFarEndOfA4kCanvas) {
  constexpr int kWidth = 3840;
  constexpr int kHeight = 2160;
  Canvas canvas(kWidth, kHeight);
  Frame frame;
  for (const Primitive& circle : {disc(1e6 + 10.3, 1000.0, 1e6, kBlack), disc(-3e4, 3e4, 4.3e4, kBlack),
                                  disc(1920.3, 1080.7, 1071.3, kBlack), disc(3830.2, 2150.9, 2.9, kBlack),
                                  disc(700.1, -1e6 + 900.2, 1e6, kBlack)}) {
    Picture picture = blankPicture(kWidth, kHeight);
    picture.primitives = {circle};
    canvas.draw(picture, frame);
    Deviation deviation;
    int edges = 0;
    for (int y = 0; y < kHeight; y += 3) {
      for (int x = 0; x < kWidth; ++x) {
        const double distance = std::hypot(x + 0.5 - circle.center.x(), y + 0.5 - circle.center.y());
        if (std::abs(distance - circle.outer) > 1.0) continue;
        ++edges;
        const double exact = exactDiscCoverage(x, y, circle.center.x(), circle.center.y(), circle.outer);
        const double difference = std::abs(pixel(frame, x, y).r - 255.0 * (1.0 - exact));
        if (difference > deviation.worst) deviation = {difference, x, y, circle.center, circle.outer, 0.0};
      }
    }
    EXPECT_GT(edges, 0) << "the circle's edge is not on the canvas";
    EXPECT_LE(deviation.worst, circle.outer > 1000.0 ? 4.0 : 2.0) << deviation;
  }
}

TEST(CanvasCoverage, RingsAreTheDifferenceOfTwoDiscs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(std::log(0.2), std::log(2000.0));
  std::uniform_real_distribution<double> width(0.1, 12.0);
  Canvas canvas(kSide, kSide);
  Frame frame;
  Deviation deviation;
  for (int i = 0; i < 400; ++i) {
    Primitive circle = circleThroughCanvas(random, std::exp(exponent(random)));
    circle.kind = Primitive::Kind::Ring;
    circle.inner = std::max(circle.outer - width(random), 0.0);
    Picture picture = blankPicture(kSide, kSide);
    picture.primitives = {circle};
    canvas.draw(picture, frame);
    deviation.add(frame, circle);
  }
  EXPECT_LE(deviation.worst, 3.0) << deviation; // the errors of two edges
}

TEST(CanvasCoverage, RadiusWhereTheFormulaChangesIsNotSeen) {
  // 4 px is where the program changes; both must give the same circle there.
  Canvas canvas(kSide, kSide);
  Frame below;
  Frame above;
  for (int i = 0; i < 50; ++i) {
    const double at = 20.0 + 0.02 * i;
    Picture picture = blankPicture(kSide, kSide);
    picture.primitives = {disc(at, at + 0.37, 4.0 - 1e-9, kBlack)};
    canvas.draw(picture, below);
    picture.primitives = {disc(at, at + 0.37, 4.0, kBlack)};
    canvas.draw(picture, above);
    for (std::size_t k = 0; k < below.rgba.size(); ++k) {
      ASSERT_NEAR(below.rgba[k], above.rgba[k], 2) << "byte " << k << " of the circle at " << at;
    }
  }
}

} // namespace
} // namespace offstage
