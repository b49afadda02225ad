#include "render/draw/axis.h"
#include "render/draw/plot_data.h"
#include "render/draw/plot_set.h"
#include "render/draw/simplify.h"
#include "render/job/scene_source.h"
#include "src/sim/world.h"
#include "tests/support/process.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

std::vector<std::string> labelsOf(const Axis& axis, int most) {
  std::vector<std::string> labels;
  for (const Axis::Tick& tick : axis.ticks(most)) labels.push_back(tick.label);
  return labels;
}

TEST(Axis, TicksAreRoundNumbers) {
  using ::testing::ElementsAre;
  EXPECT_THAT(labelsOf(Axis(0.0, 10.0, false), 6), ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(labelsOf(Axis(-1.0, 1.0, false), 5), ElementsAre("−1.0", "−0.5", "0.0", "0.5", "1.0"));
  EXPECT_THAT(labelsOf(Axis(0.13, 0.27, false), 4), ElementsAre("0.15", "0.20", "0.25"));
  EXPECT_THAT(labelsOf(Axis(0.0, 3e7, false), 4), ElementsAre("0", "1·10⁷", "2·10⁷", "3·10⁷"));
  EXPECT_THAT(labelsOf(Axis(1e-5, 10.0, true), 8),
              ElementsAre("10⁻⁵", "10⁻⁴", "10⁻³", "0.01", "0.1", "1", "10"));
  EXPECT_THAT(labelsOf(Axis(1.0, 10.0, true), 8), ElementsAre("1", "2", "5", "10"));
}

TEST(Axis, NumbersOfNarrowRangesHaveTheDigitsThatTellThemApart) {
  using ::testing::ElementsAre;
  EXPECT_THAT(labelsOf(Axis(1e6, 1e6 + 1.0, false), 5),
              ElementsAre("1000000.0", "1000000.2", "1000000.4", "1000000.6", "1000000.8", "1000001.0"));
  EXPECT_THAT(labelsOf(Axis(-394784.176101, -394784.17605, false), 3),
              ElementsAre("−394784.17610", "−394784.17608", "−394784.17606"));
  EXPECT_THAT(labelsOf(Axis(1.00001, 1.00005, false), 3), ElementsAre("1.00002", "1.00004"));
  EXPECT_THAT(labelsOf(Axis(0.0, 2e6, false), 4), ElementsAre("0", "5·10⁵", "1·10⁶", "1.5·10⁶", "2·10⁶"));
  EXPECT_THAT(labelsOf(Axis(5e10, 5.002e10, false), 2),
              ElementsAre("5.000·10¹⁰", "5.001·10¹⁰", "5.002·10¹⁰"));
  EXPECT_THAT(labelsOf(Axis(1e-9, 1.0002e-9, false), 2),
              ElementsAre("1.0000·10⁻⁹", "1.0001·10⁻⁹", "1.0002·10⁻⁹"));
}

TEST(Axis, NoTwoNumbersAreAlikeHoweverNarrowTheRange) {
  for (int exponent = -12; exponent <= 12; ++exponent) {
    for (int narrow = 0; narrow <= 10; ++narrow) {
      for (const double sign : {1.0, -1.0}) {
        const double middle = sign * 3.9478417604 * std::pow(10.0, exponent);
        const double room = std::abs(middle) * std::pow(10.0, -narrow);
        std::vector<std::string> labels = labelsOf(Axis(middle - room, middle + room, false), 6);
        ASSERT_GE(labels.size(), 2U) << middle << " ± " << room;
        std::ranges::sort(labels);
        EXPECT_EQ(std::ranges::adjacent_find(labels), labels.end())
            << *std::ranges::adjacent_find(labels) << " in " << middle << " ± " << room;
        for (const std::string& label : labels) EXPECT_LE(label.size(), 27U) << label;
      }
    }
  }
}

TEST(Axis, TicksAreAboutAsManyAsAskedForWhateverTheRange) {
  for (int exponent = -12; exponent <= 12; ++exponent) {
    for (int part = 0; part < 15; ++part) {
      const double factor = std::pow(1.17, part); // up to 9
      const double high = factor * std::pow(10.0, exponent);
      for (const int most : {3, 6, 10}) {
        const auto count = Axis(-0.3 * high, high, false).ticks(most).size();
        EXPECT_LE(count, static_cast<std::size_t>(most) + 1) << high;
        EXPECT_GE(count, 2U) << high << " with " << most;
      }
    }
  }
}

TEST(Axis, AroundHoldsAllValuesAndEndsAtTicks) {
  const Axis axis = Axis::around(3.2, 17.1, false, 6);
  EXPECT_EQ(axis.low(), 0.0);
  EXPECT_EQ(axis.high(), 20.0);
  EXPECT_EQ(axis.place(10.0), 0.5);
  const Axis log = Axis::around(0.02, 300.0, true, 6);
  EXPECT_DOUBLE_EQ(log.low(), 0.01);
  EXPECT_DOUBLE_EQ(log.high(), 1000.0);
  EXPECT_NEAR(log.place(1.0), 0.4, 1e-12);
  EXPECT_TRUE(std::isnan(log.place(-1.0)));
  const Axis single = Axis::around(5.0, 5.0, false, 4);
  EXPECT_LT(single.low(), 5.0);
  EXPECT_GT(single.high(), 5.0);
  const Axis nothing = Axis::around(INFINITY, -INFINITY, false, 4);
  EXPECT_EQ(nothing.low(), 0.0);
  EXPECT_EQ(nothing.high(), 1.0);
}

TEST(Simplify, StaysWithinTheToleranceAndKeepsItsBeginning) {
  PathSimplifier simplifier(0.1);
  std::vector<Vec2> points;
  std::vector<Vec2> before;
  for (int i = 0; i <= 2000; ++i) {
    points.emplace_back(0.25 * i, 100.0 + 80.0 * std::sin(0.01 * i));
    simplifier.add(points.back());
    const std::vector<Vec2> path = simplifier.path();
    EXPECT_EQ(path.back(), points.back());
    for (std::size_t k = 0; k + 2 < before.size(); ++k) ASSERT_EQ(path.at(k), before[k]) << "at point " << i;
    before = path;
  }
  EXPECT_LT(before.size(), 150U);
  for (const Vec2& point : points) {
    double nearest = 1e9;
    for (std::size_t k = 1; k < before.size(); ++k) {
      const Vec2 along = before[k] - before[k - 1];
      const double part = std::clamp((point - before[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (before[k - 1] + along * part - point).norm());
    }
    ASSERT_LE(nearest, 0.2) << point.transpose();
  }
}

const std::string kBall = "duration = 2.0\n[world]\ngravity = [0, 500]\n[walls]\nbottom = 0.8\n[[body]]\n"
                          "name = \"ball\"\ncenter = [100, 300]\nradius = 20\nvelocity = [31, -7]\n";

/// The numbers that a plot draws are those of `offstage trace`, to the last bit.
TEST(Plot, ValuesAreThoseOfTheTrace) {
  const TempDir dir;
  const std::string text =
      kBall + "[[plot]]\nx = \"ball.x\"\ny = [\"ball.y\", \"ball.vy\"]\n[[plot]]\ny = \"ball.vx\"\n";
  writeFile(dir / "scene.toml", text);
  const ProcessResult traced = offstage({"trace", dir / "scene.toml", "-o", dir / "trace.csv"});
  ASSERT_EQ(traced.status, 0) << traced.err;
  const Scene parsed = sceneOf(text);
  const PlotData data(parsed.plots, {parsed.clock, parsed.world, parsed.replay});
  std::istringstream lines(readFile(dir / "trace.csv"));
  std::string line;
  std::getline(lines, line);
  ASSERT_EQ(line, "frame,id,time,x,y,vx,vy,radius,group");
  std::size_t frame = 0;
  for (; std::getline(lines, line); ++frame) {
    std::vector<double> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) {
      double value = 0.0;
      std::from_chars(cell.data(), cell.data() + cell.size(), value);
      cells.push_back(value);
    }
    EXPECT_EQ(data.points(0, 0).at(frame).x, cells.at(3)) << line;
    EXPECT_EQ(data.points(0, 0).at(frame).y, cells.at(4)) << line;
    EXPECT_EQ(data.points(0, 1).at(frame).y, cells.at(6)) << line;
    EXPECT_EQ(data.points(1, 0).at(frame).x, cells.at(2)) << line;
    EXPECT_EQ(data.points(1, 0).at(frame).y, cells.at(5)) << line;
  }
  EXPECT_EQ(frame, 121U);
  EXPECT_EQ(data.points(0, 0).size(), frame);
}

std::vector<Vec2> endsOfCurve(const std::string& plot, int steps) {
  const Scene scene = sceneOf(kBall + plot);
  SceneSource source(scene, Viewport::scaled(640, 480, 1.0));
  for (int i = 0; i < steps; ++i) source.step();
  Picture picture;
  source.draw(picture);
  std::vector<Vec2> ends;
  for (const Primitive& primitive : picture.primitives)
    if (primitive.kind == Primitive::Kind::Elbow) ends.push_back(primitive.high);
  return ends;
}

TEST(Plot, CurvesGrowToThePresentUnlessWhole) {
  const std::string plot = "[[plot]]\ny = \"ball.vx\"\narea = [0, 0, 640, 480]\ncursor = false\n";
  const auto half = endsOfCurve(plot, 60);
  const auto all = endsOfCurve(plot, 120);
  const auto whole = endsOfCurve(plot + "whole = true\n", 60);
  ASSERT_EQ(half.size(), 1U); // a constant: one straight line
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole, all);
  EXPECT_LT(half[0].x(), all[0].x() - 200.0);
  EXPECT_EQ(half[0].y(), all[0].y()); // the axes stand still
}

/// A curve that grows from frame to frame, that of a plot drawn once, and of one that goes back, are the
/// same.
TEST(Plot, ACurveDoesNotDependOnTheFramesDrawnBefore) {
  const Scene scene =
      sceneOf("duration = 2\n[world]\ngravity = [0, 900]\n[walls]\nall = 0.9\n[[body]]\nname = \"ball\"\n"
              "center = [100, 200]\nradius = 10\nvelocity = [90, -400]\n[[plot]]\n"
              "y = [\"ball.vy\", \"ball.y\"]\ny_scale = \"log\"\n"); // gaps where vy < 0
  const Viewport viewport = Viewport::scaled(640, 480, 1.0);
  const TextPainter texts(viewport);
  const auto drawn = [](const PlotSet& plots, std::int64_t frame) {
    Picture picture;
    plots.draw(picture, {&frame, 1});
    std::vector<std::array<double, 5>> pieces;
    for (const Primitive& piece : picture.primitives)
      pieces.push_back(
          {static_cast<double>(piece.kind), piece.low.x(), piece.low.y(), piece.high.x(), piece.high.y()});
    return pieces;
  };
  const PlotSet growing(scene, viewport, texts);
  for (std::int64_t frame = 0; frame <= 120; ++frame) {
    const auto pieces = drawn(growing, frame);
    if (frame % 20 == 0) {
      EXPECT_EQ(pieces, drawn(PlotSet(scene, viewport, texts), frame)) << frame;
    }
  }
  EXPECT_EQ(drawn(growing, 50), drawn(PlotSet(scene, viewport, texts), 50));
}

/// Long numbers below the axis: fewer of them, each whole and clear of the next.
TEST(Plot, NumbersOfANarrowRangeDoNotRunIntoEachOther) {
  for (const double width : {160.0, 320.0, 640.0}) {
    const std::string area = "area = [0, 0, " + std::to_string(width) + ", 180]\nx_label = \"\"\n";
    std::string plot = "[[plot]]\nx_range = [1000000, 1000001]\ny_range = [0, 1]\ny = \"energy\"\n";
    plot += "text_size = 11\ncursor = false\n";
    SceneSource source(sceneOf(kBall + plot + area), Viewport::scaled(640, 480, 1.0));
    Picture picture;
    source.draw(picture);
    std::vector<std::array<double, 2>> letters;
    for (const Primitive& p : picture.primitives)
      if (p.kind == Primitive::Kind::Mask && p.high.y() > 162.0) letters.push_back({p.low.x(), p.high.x()});
    std::ranges::sort(letters);
    std::vector<int> numbers(1, 0); // letters of each
    for (std::size_t i = 0; i < letters.size(); ++i) {
      if (i > 0 && letters[i][0] > letters[i - 1][1] + 3.0) numbers.push_back(0);
      ++numbers.back();
    }
    EXPECT_GE(numbers.size(), 2U) << width;
    for (const int count : numbers) EXPECT_EQ(count, 9) << "\"1000000.0\" in a plot " << width << " px wide";
    EXPECT_LT(letters.back()[1], width);
  }
}

/// Between two frames the present is as far between their values as the bodies are between their places.
TEST(Plot, InSlowMotionThePresentMovesBetweenTheFramesToo) {
  for (const char* whole : {"false", "true"}) {
    const Scene scene =
        sceneOf(kBall + "[[plot]]\ny = \"ball.y\"\narea = [0, 0, 640, 480]\nwhole = " + whole);
    struct Present {
      Vec2 disc, end; ///< of the curve
    };
    const auto presentAt = [&scene](std::int64_t frame, double fraction) {
      SceneSource source(scene, Viewport::scaled(640, 480, 1.0));
      source.show({.moment = {frame, fraction}, .time = 1.0});
      Picture picture;
      source.draw(picture);
      Present present{Vec2::Zero(), Vec2::Zero()};
      for (const Primitive& p : picture.primitives) {
        if (p.kind == Primitive::Kind::Disc) present.disc = p.center;
        if (p.kind == Primitive::Kind::Elbow || p.kind == Primitive::Kind::Strip) present.end = p.high;
      }
      return present;
    };
    const Present before = presentAt(60, 0.0);
    const Present after = presentAt(61, 0.0);
    EXPECT_GT((after.disc - before.disc).norm(), 1.0);
    for (const double fraction : {0.25, 0.5, 0.875}) {
      const Present now = presentAt(60, fraction);
      const Vec2 wanted = before.disc + (after.disc - before.disc) * fraction;
      EXPECT_LT((now.disc - wanted).norm(), 1e-9) << now.disc.transpose() << " at " << fraction;
      if (whole == std::string("false")) {
        EXPECT_NEAR((now.end - wanted).norm(), 1.0, 1e-6) << "half the line's width: " << now.end.transpose();
      }
    }
  }
}

/// The present's disc is whole at the edge of the axes, also in the run's last frame; beyond it there is
/// none.
TEST(Plot, ThePresentsDiscIsNotCutAtTheAxes) {
  struct Case {
    const char* range;
    bool isSeen;
  };
  for (const auto& [range, isSeen] : {Case{"[0, 31]", true}, Case{"[31, 40]", true}, Case{"[0, 40]", true},
                                      Case{"[0, 30.9]", false}, Case{"[31.1, 40]", false}}) {
    SceneSource source(sceneOf(kBall + "[[plot]]\ny = \"ball.vx\"\nx_range = [0, 2]\ny_range = " + range),
                       Viewport::scaled(640, 480, 1.0));
    for (int frame = 0; frame <= 120; ++frame) {
      Picture picture;
      source.draw(picture);
      std::vector<Primitive> discs;
      for (const Primitive& p : picture.primitives)
        if (p.kind == Primitive::Kind::Disc && p.clip >= 0) discs.push_back(p);
      ASSERT_EQ(discs.size(), isSeen ? 1U : 0U) << range << " in frame " << frame;
      if (frame < 120) source.step();
      if (!isSeen) continue;
      const Primitive& disc = discs.front();
      const PixelRect clip = picture.clips.at(static_cast<std::size_t>(disc.clip));
      EXPECT_LE(clip.left, disc.center.x() - disc.outer) << range << " in frame " << frame;
      EXPECT_LE(clip.top, disc.center.y() - disc.outer) << range << " in frame " << frame;
      EXPECT_GE(clip.right, disc.center.x() + disc.outer) << range << " in frame " << frame;
      EXPECT_GE(clip.bottom, disc.center.y() + disc.outer) << range << " in frame " << frame;
    }
  }
}

TEST(Plot, LeavesEveryStateAsItIs) {
  const Viewport viewport = Viewport::scaled(640, 480, 1.0);
  SceneSource plain(sceneOf(kBall), viewport);
  SceneSource plotted(sceneOf(kBall + "[[plot]]\ny = \"energy\"\nwhole = true\n"), viewport);
  for (int i = 0; i < 120; ++i) {
    ASSERT_EQ(plain.stateHash(), plotted.stateHash()) << "frame " << i;
    plain.step();
    plotted.step();
  }
}

TEST(Plot, TellsWhatIsWrong) {
  using ::testing::HasSubstr;
  EXPECT_THAT(
      errorsOf(kBall +
               "[[plot]]\ny = [\"ball.spede\", 3]\nx_range = [2, 1]\ny_scale = \"log\"\ny_range = [0, 1]\n"
               "area = [0, 0, 10, 10]\n[[plot]]\ntitle = \"x\"\n[[plot]]\ny = [\"ball.x\", \"ball.y\"]\n"
               "color = [\"red\"]\nx = [\"t\", \"t\", \"t\"]\n"),
      ::testing::ElementsAre(
          HasSubstr("scene.toml:12:6: error: value 1 of 'y' in [[plot]] is no value of the scene"),
          HasSubstr("scene.toml:12:20: error: value 2 of 'y' in [[plot]] must be the name of a value"),
          HasSubstr("scene.toml:13:11: error: 'x_range' in [[plot]] must have the smaller number first"),
          HasSubstr("scene.toml:15:11: error: 'y_range' in [[plot]] must be above 0"),
          HasSubstr("scene.toml:16:8: error: 'area' in [[plot]] must be at least 40 px"),
          HasSubstr("scene.toml:17:1: error: [[plot]] needs 'y'"),
          HasSubstr("scene.toml:22:5: error: 'x' in [[plot]] must be one value or as many")));
  EXPECT_THAT(
      errorsOf("[frame]\nsize = [640, 75]\n[[plot]]\ny = \"energy\"\n"),
      ::testing::ElementsAre("scene.toml:3:1: error: [[plot]] needs an 'area' at least 40 px wide and "
                             "high: by default it is 320x37.5 px"));
}

} // namespace
} // namespace offstage::test
