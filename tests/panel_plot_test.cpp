#include "render/draw/plot_data.h"
#include "render/draw/plot_set.h"
#include "src/sim/probe.h"
#include "src/sim/world.h"
#include "tests/support/scene_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A planet by three methods; the second takes ten steps a second, the third is in metres.
const std::string kPlanets = R"(duration = 2.0
[frame]
size = [320, 240]
[world]
gravity = [0, 0]
[[force]]
type = "attract"
body = "planet"
to = [160, 120]
strength = 2e6
[[body]]
name = "planet"
center = [240, 120]
radius = 6
velocity = [0, -150]
[[panel]]
title = "Euler"
color = "#d55e00"
world.integrator = "explicit-euler"
[[panel]]
title = "slow"
color = "#0072b2"
clock.fps = 10
[[panel]]
color = "#009e73"
world.integrator = "rk4"
)";

/// The pieces of a curve and its disc, to the bit; axes and texts are of other kinds.
using Piece = std::tuple<int, std::array<std::uint8_t, 3>, std::array<double, 6>>;

std::vector<Piece> piecesOf(const Picture& picture) {
  std::vector<Piece> pieces;
  for (const Primitive& p : picture.primitives) {
    const bool disc = p.kind == Primitive::Kind::Disc;
    if (!disc && p.kind != Primitive::Kind::Strip && p.kind != Primitive::Kind::Elbow) continue;
    const Vec2 low = disc ? Vec2::Zero() : p.low;
    const Vec2 high = disc ? Vec2::Zero() : p.high;
    const Vec2 center = disc ? p.center : Vec2::Zero();
    pieces.push_back({static_cast<int>(p.kind),
                      {p.color.r, p.color.g, p.color.b},
                      {low.x(), low.y(), high.x(), high.y(), center.x(), center.y()}});
  }
  return pieces;
}

std::vector<Piece> drawn(const Scene& scene, const std::vector<std::int64_t>& frames) {
  const Viewport viewport = Viewport::scaled(1000, 800, 1.0);
  const TextPainter texts(viewport);
  const PlotSet plots(scene, viewport, texts);
  Picture picture;
  plots.draw(picture, frames);
  return piecesOf(picture);
}

bool isIn(const std::vector<Piece>& pieces, const Piece& piece) {
  return std::ranges::find(pieces, piece) != pieces.end();
}

/// The same diagram of one panel's world alone, drawn from its own [[plot]].
TEST(PanelPlot, DrawsWhatAPlotOfEachPanelDrawsToTheLastBit) {
  const std::string look = "area = [10, 20, 600, 400]\nx_range = [0, 2]\ny_range = [-3e4, 3e4]\n";
  const Scene all = sceneOf(kPlanets + "[[panels.plot]]\ny = \"planet.energy\"\n" + look);
  const std::vector<std::int64_t> frames{75, 12, 75}; // at 1.25 s
  const std::vector<Piece> together = drawn(all, frames);
  const std::size_t cut = kPlanets.find("[[panel]]");
  const std::array<const char*, 3> own{"[world]\ngravity = [0, 0]\nintegrator = \"explicit-euler\"\n",
                                       "[clock]\nfps = 10\n[world]\ngravity = [0, 0]\n",
                                       "[world]\ngravity = [0, 0]\nintegrator = \"rk4\"\n"};
  const std::array<const char*, 3> colors{"#d55e00", "#0072b2", "#009e73"};
  const std::string world = "[world]\ngravity = [0, 0]\n";
  std::size_t found = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    std::string text = kPlanets.substr(0, cut);
    text.replace(text.find(world), world.size(), own.at(i));
    text += fmt::format("[[plot]]\ny = \"planet.energy\"\ncolor = \"{}\"\n", colors.at(i));
    const Scene alone = sceneOf(text + look);
    std::size_t curves = 0;
    for (const Piece& piece : drawn(alone, {frames[i]})) {
      if (std::get<1>(piece) != std::array<std::uint8_t, 3>{alone.plots[0].curves[0].color.red,
                                                            alone.plots[0].curves[0].color.green,
                                                            alone.plots[0].curves[0].color.blue})
        continue;
      ++curves;
      EXPECT_TRUE(isIn(together, piece)) << colors.at(i) << ", piece " << curves;
    }
    EXPECT_GE(curves, 2U) << colors.at(i); // a path and a disc
    found += curves;
  }
  std::set<std::array<std::uint8_t, 3>> ofCurves;
  for (const PlotCurve& curve : all.panels.plots.at(0).plot.curves)
    ofCurves.insert({curve.color.red, curve.color.green, curve.color.blue});
  const auto pieces = std::ranges::count_if(
      together, [&](const Piece& piece) { return ofCurves.contains(std::get<1>(piece)); });
  EXPECT_EQ(static_cast<std::size_t>(pieces), found) << "and nothing else";
}

/// The values are those that the pane's own world has: `trace`'s, and those of its probes.
TEST(PanelPlot, HasTheValuesOfThePanelsOwnProbes) {
  const Scene scene =
      sceneOf(kPlanets + "[[plot]]\ny = [\"planet.energy\", \"planet.x\"]\n[[panels.plot]]\n"
                         "y = [\"planet.energy\", \"planet.x\"]\nof = 2\narea = [0, 0, 300, 200]\n");
  // [[plot]] stands in every pane, [[panels.plot]] over them.
  const Scene& pane = *scene.panels.panels.at(1).scene;
  ASSERT_EQ(pane.plots.size(), 1U);
  const PanelPlot& over = scene.panels.plots.at(0);
  EXPECT_THAT(over.panels, ElementsAre(1U, 1U));
  const PlotData own(pane.plots, {pane.clock, pane.world, pane.replay});
  const PlotData data({over.plot}, {pane.clock, pane.world, pane.replay});
  World world(pane.world);
  for (std::int64_t frame = 0;; ++frame) {
    for (std::size_t curve = 0; curve < 2; ++curve) {
      const PlotData::Point& point = data.points(0, curve).at(static_cast<std::size_t>(frame));
      EXPECT_EQ(point.y, valueOf(pane.plots[0].curves[curve].y, snapshotOf(world))) << frame;
      EXPECT_EQ(point.y, own.points(0, curve).at(static_cast<std::size_t>(frame)).y) << frame;
      EXPECT_EQ(point.x, world.time()) << frame;
    }
    if (frame == pane.clock.steps()) break;
    world.step(pane.clock.tick(frame + 1));
  }
  EXPECT_EQ(world.frame(), 20);
}

TEST(PanelPlot, NamesAndColoursItsCurvesByPanel) {
  const auto plotOf = [](const std::string& keys) {
    return sceneOf(kPlanets + "[[panels.plot]]\narea = [0, 0, 300, 200]\n" + keys).panels.plots.at(0);
  };
  const auto names = [](const PanelPlot& plot) {
    std::vector<std::string> all;
    for (const PlotCurve& curve : plot.plot.curves) all.push_back(curve.name);
    return all;
  };
  const PanelPlot each = plotOf("y = \"planet.vx\"\n");
  EXPECT_THAT(each.panels, ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(names(each), ElementsAre("Euler", "slow", "panel 3"));
  EXPECT_EQ(each.plot.curves[1].color.blue, 0xb2);
  EXPECT_EQ(each.plot.y.label, "planet.vx (px/s)");
  EXPECT_EQ(each.plot.x.label, "t (s)");
  EXPECT_TRUE(each.plot.legend);
  EXPECT_EQ(each.plot.x.range, (std::array{0.0, 2.0}));

  const PanelPlot two =
      plotOf("of = [3, \"Euler\"]\ny = \"energy\"\ncolor = [\"red\", \"lime\"]\nname = [\"a\", \"b\"]\n");
  EXPECT_THAT(two.panels, ElementsAre(2U, 0U));
  EXPECT_THAT(names(two), ElementsAre("a", "b"));
  EXPECT_EQ(two.plot.curves[0].color.red, 255);

  const PanelPlot one = plotOf("of = \"slow\"\ny = [\"planet.x\", \"planet.y\"]\n");
  EXPECT_THAT(one.panels, ElementsAre(1U, 1U));
  EXPECT_THAT(names(one), ElementsAre("planet.x", "planet.y"));

  const PanelPlot pairs =
      plotOf("of = [\"slow\", 3]\ny = [\"planet.vx\", \"planet.vy\"]\nx = [\"planet.x\", \"planet.y\"]\n");
  EXPECT_THAT(names(pairs), ElementsAre("slow: planet.vx", "panel 3: planet.vy"));
  EXPECT_EQ(pairs.plot.curves[1].x.quantity, Quantity::Y);
  EXPECT_FALSE(pairs.plot.overTime);
}

TEST(PanelPlot, TakesTheCellsThatTheGridLeavesFree) {
  const std::string plot = "[[panels.plot]]\ny = \"energy\"\n";
  const auto area = [&](const std::string& panels) {
    return sceneOf(kPlanets + panels + plot).panels.plots.at(0).plot.area;
  };
  const Scene scene = sceneOf(kPlanets + "[panels]\ncolumns = 2\n");
  const auto last = scene.panels.place(2, scene.size[0], scene.size[1]);
  const auto free = area("[panels]\ncolumns = 2\n");
  EXPECT_EQ(free,
            (std::array{16.0 + 320.0 + 16.0, 2 * 16.0 + 240.0 + 20.0, 320.0, 260.0})); // of 688 × 568 px
  EXPECT_EQ(free[1] + free[3], last[1] + last[3]) << "down to where the last pane ends";
  EXPECT_EQ(area("[panels]\nlayout = \"overlaid\"\n"), (std::array{160.0, 0.0, 160.0, 120.0}));
}

/// A panel whose frames are rarer shows its last one that is due; the line stands at the latest of all.
TEST(PanelPlot, ShowsEachPanelsOwnPresent) {
  const Scene scene =
      sceneOf(kPlanets + "[[panels.plot]]\ny = \"planet.x\"\nx_range = [0, 2]\nlegend = false\n"
                         "area = [0, 0, 600, 400]\n");
  std::vector<double> discs;
  for (const Piece& piece : drawn(scene, {59, 9, 59})) // 0.9833 s; the second panel is at 0.9 s
    if (std::get<0>(piece) == static_cast<int>(Primitive::Kind::Disc)) discs.push_back(std::get<2>(piece)[4]);
  ASSERT_EQ(discs.size(), 3U);
  EXPECT_EQ(discs[0], discs[2]);
  EXPECT_LT(discs[1], discs[0]);
  const auto all = drawn(scene, {120, 20, 120});
  std::vector<double> ends;
  for (const Piece& piece : all)
    if (std::get<0>(piece) == static_cast<int>(Primitive::Kind::Disc)) ends.push_back(std::get<2>(piece)[4]);
  ASSERT_EQ(ends.size(), 3U);
  const double perSecond = (ends[0] - discs[0]) / (2.0 - 59.0 / 60.0);
  EXPECT_NEAR((discs[0] - discs[1]) / perSecond, 59.0 / 60.0 - 0.9, 1e-9);
}

TEST(PanelPlot, TellsWhatIsWrong) {
  const auto wrong = [](const std::string& keys) { return errorsOf(kPlanets + "[[panels.plot]]\n" + keys); };
  const std::string fine = "y = \"energy\"\n";
  const std::string area = "area = [0, 0, 300, 200]\n";
  EXPECT_THAT(wrong(area), ElementsAre(HasSubstr("scene.toml:27:1: error: [[panels.plot]] needs 'y'")));
  EXPECT_THAT(wrong(fine), ElementsAre(HasSubstr("scene.toml:27:1: error: [[panels.plot]] needs 'area'")));
  EXPECT_THAT(wrong(fine + area + "of = \"Eular\"\n"),
              ElementsAre(HasSubstr(
                  "scene.toml:30:6: error: 'of' in [[panels.plot]] names an unknown panel, \"Eular\"; "
                  "did you mean \"Euler\"?")));
  EXPECT_THAT(wrong(fine + area + "of = [1, 4]\n"),
              ElementsAre(HasSubstr("scene.toml:30:10: error: value 2 of 'of' in [[panels.plot]] must be")));
  EXPECT_THAT(wrong(fine + area + "of = [1.5]\n"),
              ElementsAre(HasSubstr("the title of a panel or its number, from 1")));
  EXPECT_THAT(wrong(fine + area + "of = []\n"),
              ElementsAre(HasSubstr("30:6: error: 'of' in [[panels.plot]] must have 1 to 32")));
  EXPECT_THAT(wrong("y = \"sun.energy\"\n" + area),
              ElementsAre(HasSubstr(
                  "scene.toml:28:5: error: 'y' in [[panels.plot]] is no value of panel \"Euler\": there is "
                  "no body and no group \"sun\"")));
  EXPECT_THAT(wrong("y = 3\n" + area),
              ElementsAre(HasSubstr("28:5: error: 'y' in [[panels.plot]] must be the name of a value")));
  EXPECT_THAT(
      wrong("y = [\"energy\", \"kinetic\"]\n" + area),
      ElementsAre(HasSubstr(
          "28:5: error: 'y' in [[panels.plot]] must be one value or as many as there are panels, 3")));
  EXPECT_THAT(
      wrong(fine + "x = [\"t\", \"t\"]\n" + area),
      ElementsAre(HasSubstr(
          "29:5: error: 'x' in [[panels.plot]] must be one value or as many as there are curves, 3")));
  EXPECT_THAT(
      wrong(fine + area + "color = [\"red\"]\n"),
      ElementsAre(HasSubstr("'color' in [[panels.plot]] must have as many values as there are curves, 3")));
  EXPECT_THAT(wrong(fine + area + "panel = 1\n"),
              ElementsAre(HasSubstr("30:1: error: unknown key 'panel' in [[panels.plot]]")));
  EXPECT_THAT(errorsOf(kPlanets + "[panels]\nplot = 3\n"),
              ElementsAre(HasSubstr("an array of tables, [[panels.plot]]")));
  EXPECT_THAT(
      errorsOf(kPlanets + "[[panel]]\ntitle = \"slow\"\n[[panels.plot]]\nof = \"slow\"\n" + fine + area),
      ElementsAre(
          HasSubstr("30:6: error: 'of' in [[panels.plot]] names several panels, \"slow\": give the number")));
  EXPECT_THAT(
      errorsOf(kPlanets +
               "[[panel.body]]\ncenter = [1, 2]\nradius = 3\n[[panel.force]]\ntype = \"drag\"\n"
               "[[panels.plot]]\ny = \"planet.x\"\n" +
               area),
      ElementsAre(HasSubstr("is no value of panel \"panel 3\": there is no body and no group \"planet\"")))
      << "each panel has its own names";
}

} // namespace
} // namespace offstage::test
