#include "render/draw/plot_painter.h"
#include "render/job/scene_source.h"
#include "tests/support/scene_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr int kFrames = 120;

using Curve = std::function<double(double)>; ///< over 0 … 1

Plot plotOf(std::size_t curves, std::array<double, 4> area = {20, 10, 400, 300}) {
  Plot plot;
  for (std::size_t i = 0; i < curves; ++i)
    plot.curves.push_back({{}, {}, "curve " + std::to_string(i), {static_cast<std::uint8_t>(i + 1), 99, 0}});
  plot.x.range = {{0.0, 1.0}};
  plot.y.range = {{0.0, 1.0}};
  plot.area = area;
  plot.background = Color{255, 255, 255};
  return plot;
}

using Box = std::pair<Vec2, Vec2>; ///< low, high

struct Drawn {
  std::optional<Box> box;       ///< behind the legend in a corner
  std::vector<Primitive> discs; ///< of the present, in all frames
  std::vector<Box> lines;       ///< the legend's, in the last frame
  bool isStill = true;          ///< the legend is the same in all frames
};

Drawn drawn(const Plot& plot, const std::vector<Curve>& curves) {
  std::vector<PlotData::Points> points;
  for (const Curve& curve : curves) {
    points.emplace_back();
    for (int frame = 0; frame <= kFrames; ++frame) {
      const double x = static_cast<double>(frame) / kFrames;
      points.back().push_back({x, curve(x)});
    }
  }
  std::vector<const PlotData::Points*> all;
  all.reserve(points.size());
  for (const PlotData::Points& each : points) all.push_back(&each);
  const Viewport viewport = Viewport::scaled(640, 480, 1.0);
  const PlotPainter painter(plot, all, viewport, TextPainter(viewport));
  Drawn result;
  for (std::int64_t frame = 0; frame <= kFrames; ++frame) {
    Picture picture;
    painter.draw(picture, std::vector<std::int64_t>(curves.size(), frame));
    const auto isDisc = [](const Primitive& p) { return p.kind == Primitive::Kind::Disc; };
    std::ranges::copy_if(picture.primitives, std::back_inserter(result.discs), isDisc);
    std::vector<Box> lines;
    std::optional<Box> box;
    auto p = picture.primitives.end();
    while (p != picture.primitives.begin() && !isDisc(*std::prev(p))) --p;
    for (; p != picture.primitives.end(); ++p) {
      if (p->color.a == 215)
        box = Box{p->low, p->high};
      else if (p->color.g == 99)
        lines.push_back({p->low, p->high});
    }
    if (frame > 0) result.isStill = result.isStill && box == result.box && lines == result.lines;
    result.box = box;
    result.lines = lines;
  }
  return result;
}

std::size_t hiddenBy(const Box& box, const std::vector<Primitive>& discs) {
  return static_cast<std::size_t>(std::ranges::count_if(discs, [&box](const Primitive& disc) {
    const Vec2 nearest = disc.center.cwiseMax(box.first).cwiseMin(box.second);
    return (nearest - disc.center).norm() < disc.outer;
  }));
}

/// Upper right, as long as nothing is there; then upper left, lower right, lower left.
TEST(PlotLegend, StandsInACornerThatNoCurveGoesThroughInTheWholeRun) {
  struct Case {
    const char* name;
    Curve curve;
    bool right, up;
  };
  const Plot plot = plotOf(2);
  for (const Case& each : {Case{"falls", [](double x) { return 1.0 - x; }, true, true},
                           Case{"rises at the end", [](double x) { return std::pow(x, 8.0); }, false, true},
                           Case{"is at the top", [](double) { return 0.95; }, true, false},
                           Case{"is at the top and falls",
                                [](double x) { return 0.98 - 0.97 * std::pow(x, 8.0); }, false, false}}) {
    const Drawn result = drawn(plot, {each.curve, each.curve});
    ASSERT_TRUE(result.box) << each.name;
    const auto& [low, high] = *result.box;
    EXPECT_EQ(0.5 * (low.x() + high.x()) > 240.0, each.right) << each.name << ": " << low.transpose();
    EXPECT_EQ(0.5 * (low.y() + high.y()) < 150.0, each.up) << each.name << ": " << low.transpose();
    EXPECT_EQ(result.discs.size(), 2U * (kFrames + 1)) << each.name;
    EXPECT_EQ(hiddenBy(*result.box, result.discs), 0U) << each.name;
    EXPECT_TRUE(result.isStill) << each.name;
  }
}

TEST(PlotLegend, StandsAboveTheAxesWhereNoCornerIsFree) {
  Plot plot = plotOf(2);
  const std::vector<Curve> everywhere{[](double x) { return 0.5 + 0.5 * std::cos(60.0 * x); },
                                      [](double) { return 1.0; }};
  for (const char* title : {"", "Title"}) {
    plot.title = title;
    const Drawn result = drawn(plot, everywhere);
    EXPECT_FALSE(result.box) << result.box->first.transpose();
    ASSERT_EQ(result.lines.size(), 2U);
    EXPECT_TRUE(result.isStill);
    double top = 1e9;
    for (const Primitive& disc : result.discs) top = std::min(top, disc.center.y() - disc.outer);
    for (const Box& line : result.lines) {
      EXPECT_LT(line.second.y() + 0.5 * plot.textSize, top) << title;
      EXPECT_GT(line.first.y() - 0.5 * plot.textSize, plot.area[1]) << title;
      EXPECT_GT(line.first.x(), plot.area[0]) << title;
    }
  }
}

TEST(PlotLegend, TakesAsManyRowsAsItsNamesNeedInColumns) {
  Plot plot = plotOf(5);
  const Curve wave = [](double x) { return 0.5 + 0.5 * std::cos(60.0 * x); };
  const std::vector<Curve> waves(5, wave);
  const Drawn few = drawn(plot, waves);
  ASSERT_EQ(few.lines.size(), 5U);
  EXPECT_FALSE(few.box);
  EXPECT_EQ(few.lines[0].first.y(), few.lines[2].first.y()) << "three fit into a row";
  EXPECT_GT(few.lines[3].first.y(), few.lines[0].first.y() + plot.textSize);
  EXPECT_EQ(few.lines[3].first.x(), few.lines[0].first.x());
  EXPECT_EQ(few.lines[4].first.x(), few.lines[1].first.x());

  plot.curves[3].name = "a name that is longer than all the others, and longer than the plot is wide";
  const Drawn one = drawn(plot, waves);
  ASSERT_EQ(one.lines.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ(one.lines[i].first.x(), one.lines[0].first.x());
    EXPECT_GT(one.lines[i].first.y(), one.lines[i - 1].first.y() + plot.textSize);
  }
}

/// However small the plot is: inside the axes where no curve goes, or above all curves, or not at all.
TEST(PlotLegend, CoversNoCurveInASmallPlot) {
  const Curve wave = [](double x) { return 0.5 + 0.5 * std::cos(60.0 * x); };
  const std::vector<Curve> waves{wave, wave, [](double) { return 1.0; }};
  int shown = 0;
  int leftOut = 0;
  for (const double width : {60.0, 90.0, 160.0, 240.0}) {
    for (const double height : {50.0, 70.0, 90.0, 130.0, 200.0}) {
      const Plot plot = plotOf(3, {20, 10, width, height});
      const Drawn result = drawn(plot, waves);
      const std::string size = fmt::format("in {}x{} px", width, height);
      EXPECT_TRUE(result.isStill) << size;
      ++(result.lines.empty() ? leftOut : shown);
      if (result.box) {
        EXPECT_EQ(hiddenBy(*result.box, result.discs), 0U) << size;
      }
      if (result.box || result.lines.empty()) continue;
      double top = 1e9;
      for (const Primitive& disc : result.discs) top = std::min(top, disc.center.y() - disc.outer);
      for (const Box& line : result.lines) {
        EXPECT_LT(line.second.y() + 0.3 * plot.textSize, top) << size;
        EXPECT_GE(line.first.y(), plot.area[1]) << size;
        EXPECT_GE(line.first.x(), plot.area[0]) << size;
        EXPECT_LE(line.second.x(), plot.area[0] + width) << size;
      }
    }
  }
  EXPECT_GE(shown, 8);
  EXPECT_GE(leftOut, 2);
}

/// Parts that are clipped at the axes hide nothing, and gaps are none.
TEST(PlotLegend, PassesByWhatIsNotDrawn) {
  const Plot plot = plotOf(2);
  const Curve above = [](double x) { return x < 0.4 ? 0.1 : 3.0; };
  const Curve gone = [](double x) { return x < 0.4 ? 0.1 : std::nan(""); };
  const Drawn result = drawn(plot, {above, gone});
  ASSERT_TRUE(result.box);
  EXPECT_GT(result.box->first.x(), 240.0);
  EXPECT_LT(result.box->first.y(), 100.0);
}

/// An elastic ball's energies, and those of two panels in one diagram.
TEST(PlotLegend, IsAboveEnergiesThatFillTheAxes) {
  const std::string ball = "duration = 5\n[world]\ngravity = [0, 500]\n[walls]\nbottom = 1\n[[body]]\n"
                           "name = \"ball\"\ncenter = [100, 80]\nradius = 30\nvelocity = [80, 0]\n";
  const auto boxes = [](const std::string& text) {
    const Scene scene = sceneOf(text);
    SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], 1.0));
    Picture picture;
    source.draw(picture);
    return std::ranges::count_if(picture.primitives, [](const Primitive& p) { return p.color.a == 215; });
  };
  EXPECT_EQ(boxes(ball + "[[plot]]\ny = [\"ball.kinetic\", \"ball.potential\", \"ball.energy\"]\n"), 0);
  EXPECT_EQ(boxes(ball + "[[plot]]\ny = [\"ball.x\", \"ball.vx\"]\n"), 1);
  EXPECT_EQ(boxes(ball +
                  "[[panel]]\n[[panel]]\nworld.integrator = \"rk4\"\n[[panels.plot]]\n"
                  "area = [0, 0, 320, 240]\ny = [\"ball.kinetic\", \"ball.potential\"]\nof = [1, 2]\n"),
            0);
}

} // namespace
} // namespace offstage::test
