#include "render/draw/overlay_history.h"
#include "render/job/render_options.h"
#include "render/job/scene_source.h"
#include "render/stage/game_object.h"
#include "render/stage/stage_source.h"
#include "tests/support/canvas_pictures.h"
#include "tests/support/process.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

const std::string kWorld = R"(
duration = 3.0
seed = 4
[world]
gravity = [0, 400]
[walls]
all = 0.9
[[force]]
type = "spring"
group = "hanging"
to = [320, 100]
stiffness = 9
[[collide]]
between = ["balls", "balls"]
[[body]]
name = "ball"
group = "balls"
center = [100, 100]
radius = 30
velocity = [250, 0]
[[body]]
group = "balls"
center = [400, 300]
radius = 30
velocity = [-250, -200]
[[body]]
group = "hanging"
center = [200, 250]
radius = 9
mass = 2
[[spawn]]
every = 0.5
x = { int = 640 }
y = { int = 100 }
radius = { int = 20 }
vx = { spread = 100 }
group = "balls"
)";

const std::string kEveryOverlay = R"(
[grid]
[[trail]]
[[trail]]
of = "ball"
length = 0.4
fade = false
layer = "front"
[[ghost]]
every = 0.2
[[outline]]
[[mark]]
[[arrow]]
[[arrow]]
quantity = "acceleration"
[[arrow]]
quantity = "force"
[[contact_mark]]
[[ruler]]
from = [0, 0]
to = "ball"
)";

SceneSource sourceOf(const std::string& text) {
  const Scene scene = sceneOf(text);
  return {scene, Viewport::scaled(scene.size[0], scene.size[1], scene.scale)};
}

TEST(Overlay, LeavesEveryStateOfTheSimulationAsItIs) {
  const Scene plainScene = sceneOf(kWorld);
  const Scene fullScene = sceneOf(kWorld + kEveryOverlay);
  const Viewport viewport = Viewport::scaled(640, 480, 1.0);
  SceneSource plain(plainScene, viewport);
  SceneSource full(fullScene, viewport);
  Picture picture;
  for (std::int64_t frame = 0; frame < plain.clock().steps(); ++frame) {
    full.draw(picture);
    ASSERT_EQ(full.stateHash(), plain.stateHash()) << "frame " << frame;
    plain.step();
    full.step();
  }
  EXPECT_GT(picture.primitives.size(), 200U);
}

/// Chunks, workers and a late start draw the same past.
TEST(Overlay, PixelsDoNotDependOnWhereARenderBegins) {
  const TempDir dir;
  writeFile(dir / "scene.toml", kWorld + kEveryOverlay);
  const auto hashes = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"render", dir / "scene.toml", "--hash", dir / "hash.txt"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult result = offstage(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return readFile(dir / "hash.txt");
  };
  const std::string whole = hashes({});
  const std::string late = hashes({"--from", "2.5"});
  ASSERT_FALSE(late.empty());
  EXPECT_TRUE(whole.ends_with(late)) << late.substr(0, 120) << "\nnot in\n"
                                     << whole.substr(whole.size() - 600);
  EXPECT_EQ(hashes({"-o", dir / "a%04d.png", "--jobs", "2"}), whole);
  EXPECT_EQ(hashes({"-o", dir / "b%04d.png", "--jobs", "0"}), whole);
}

TEST(Overlay, HistoryKeepsPlacesGhostsAndContacts) {
  Overlays overlays;
  overlays.trails.push_back({.length = 1.0});
  overlays.ghosts.push_back({.every = 0.25, .length = 0.6});
  overlays.contactMarks.push_back({.duration = 0.5});
  OverlayHistory history(overlays);
  std::vector<Body> bodies(2);
  bodies[1].id = 1;
  bodies[0].radius = bodies[1].radius = 10.0;
  for (int frame = 0; frame <= 60; ++frame) {
    const double time = frame / 20.0; // 3 s
    bodies[0].position = Vec2(100.0 * time, 50.0);
    bodies[1].position = Vec2(0.1 * time, 70.0); // slower than a place a half px
    std::vector<Event> events;
    if (frame == 50) events.push_back({frame, EventKind::Collide, 0, 1, time, 0.0, 0.0});
    history.note(time, bodies, events);
  }
  const OverlayHistory::Track& track = history.tracks().at(0);
  EXPECT_EQ(track.head.at, Vec2(300.0, 50.0));
  EXPECT_EQ(track.head.time, 3.0);
  ASSERT_EQ(track.places.size(), 22U); // a second at 20 frames a second, both ends, and the one before
  EXPECT_DOUBLE_EQ(track.places.front().time, 1.95);
  EXPECT_EQ(history.tracks().at(1).places.size(), 1U);
  ASSERT_EQ(history.ghosts(0).size(), 6U); // 2.5, 2.75 and 3 s, two bodies
  EXPECT_EQ(history.ghosts(0).front().time, 2.5);
  ASSERT_EQ(history.contacts().size(), 1U);
  const OverlayHistory::Contact& contact = history.contacts().front();
  EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-12);
  EXPECT_NEAR((contact.at - Vec2(250.0, 50.0)).norm(), 10.0, 1e-9);
}

TEST(Overlay, ATrailOfABodyThatIsGoneStaysUntilItIsOld) {
  Overlays overlays;
  overlays.trails.push_back({.length = 0.5});
  OverlayHistory history(overlays);
  std::vector<Body> bodies(1);
  history.note(0.0, bodies, {});
  bodies[0].position = Vec2(30.0, 0.0);
  history.note(0.1, bodies, {});
  history.note(0.5, {}, {});
  EXPECT_EQ(history.tracks().size(), 1U);
  history.note(0.7, {}, {});
  EXPECT_EQ(history.tracks().size(), 1U); // it is still seen at moments soon after 0.5 s
  history.note(0.8, {}, {});
  EXPECT_TRUE(history.tracks().empty());
}

const Primitive* firstOf(const Picture& picture, Primitive::Kind kind) {
  const auto found = std::ranges::find(picture.primitives, kind, &Primitive::kind);
  return found == picture.primitives.end() ? nullptr : &*found;
}

TEST(Overlay, ArrowsAreAsLongAsTheQuantityTimesTheScale) {
  const std::string body = "[world]\ngravity = [0, 30]\n[[body]]\ncenter = [50, 60]\nradius = 5\nmass = 4\n"
                           "velocity = [20, -10]\nacceleration = [5, 0]\n";
  const auto tip = [&](const std::string& quantity) {
    SceneSource source = sourceOf(body + "[[arrow]]\nscale = 2\nquantity = \"" + quantity + "\"\n");
    Picture picture;
    source.draw(picture);
    const Primitive* arrow = firstOf(picture, Primitive::Kind::Arrow);
    return arrow == nullptr ? Vec2(NAN, NAN) : arrow->high;
  };
  EXPECT_EQ(tip("velocity"), Vec2(90.0, 40.0));
  EXPECT_EQ(tip("acceleration"), Vec2(60.0, 120.0));
  EXPECT_EQ(tip("force"), Vec2(90.0, 300.0));
}

/// All of a trail fades in the same frame, every sixteenth of its length; in all other frames only its head
/// and the body are drawn anew.
TEST(Overlay, BetweenItsStepsOnlyATrailsHeadChanges) {
  SceneSource source =
      sourceOf("duration = 6\n[world]\ngravity = [0, 90]\n[[body]]\ncenter = [50, 300]\nradius = 8\n"
               "velocity = [60, -180]\n[[trail]]\nlength = 1.6\n"); // six frames a step
  const auto pieces = [&source] {
    Picture picture;
    source.draw(picture);
    std::vector<std::array<double, 7>> list;
    for (const Primitive& piece : picture.primitives)
      list.push_back({static_cast<double>(piece.kind), piece.low.x(), piece.low.y(), piece.high.x(),
                      piece.high.y(), piece.center.x(), static_cast<double>(piece.color.a)});
    return list;
  };
  for (int i = 0; i < 220; ++i) source.step(); // the trail has its length
  auto before = pieces();
  ASSERT_GE(before.size(), 17U);
  for (int frame = 221; frame <= 300; ++frame) {
    source.step();
    auto now = pieces();
    const auto same = static_cast<std::size_t>(
        std::ranges::count_if(before, [&](const auto& piece) { return std::ranges::count(now, piece) > 0; }));
    if (frame % 6 == 0) {
      EXPECT_LE(same, 1U) << frame;
    } else {
      EXPECT_GE(same + 3, before.size()) << frame;
    }
    before = std::move(now);
  }
}

/// A picture shows the bodies of an accumulator between the last two steps, here 40 px apart.
/// How far to the right pieces of paths reach; 0 without any.
double reachOf(const Picture& picture) {
  double reach = 0.0;
  for (const Primitive& piece : picture.primitives) {
    if (piece.kind == Primitive::Kind::Strip || piece.kind == Primitive::Kind::Elbow)
      reach = std::max(reach, piece.high.x());
  }
  return reach;
}

TEST(Overlay, TrailOfAnAccumulatorEndsWhereItsBodyIsDrawn) {
  SceneSource source = sourceOf("[clock]\nstep = \"accumulator\"\ndt = 0.1\n[world]\ngravity = [0, 0]\n"
                                "[[body]]\ncenter = [50, 60]\nradius = 2\nvelocity = [400, 0]\n"
                                "[[trail]]\nfade = false\n");
  for (int frame = 1; frame <= 40; ++frame) {
    source.step();
    if (frame < 12) continue; // it has begun to move
    Picture picture;
    source.draw(picture);
    const Primitive* ball = firstOf(picture, Primitive::Kind::Disc);
    ASSERT_NE(ball, nullptr);
    EXPECT_NEAR(reachOf(picture), ball->center.x(), 1e-9) << "frame " << frame;
  }
}

TEST(Overlay, BetweenTwoFramesShowsNothingOfTheLaterOne) {
  const std::string world = "[clock]\nfps = 10\n[world]\ngravity = [0, 0]\n[[body]]\ncenter = [50, 60]\n"
                            "radius = 8\nvelocity = [1000, 0]\n";
  const auto pictureAt = [&](const std::string& overlay, std::int64_t frame, double fraction) {
    SceneSource source = sourceOf(world + overlay);
    source.show({.moment = {frame, fraction}, .time = 0.1 * (static_cast<double>(frame) + fraction)});
    Picture picture;
    source.draw(picture);
    return picture;
  };
  // The trail ends under its body, at 50 + 1000 t.
  for (const double fraction : {0.05, 0.5, 0.95}) {
    EXPECT_NEAR(reachOf(pictureAt("[[trail]]\nfade = false\n", 1, fraction)), 150.0 + 100.0 * fraction, 1e-9)
        << "fraction " << fraction;
  }
  // The ghosts of 0 and 0.1 s and the body; from 0.2 s on one more.
  EXPECT_EQ(pictureAt("[[ghost]]\nevery = 0.1\n", 1, 0.5).primitives.size(), 3U);
  EXPECT_EQ(pictureAt("[[ghost]]\nevery = 0.1\n", 2, 0.0).primitives.size(), 4U);
  // What the body runs into at 0.2 s is marked from then on.
  const std::string contact =
      "group = \"ball\"\n[[body]]\ncenter = [260, 60]\nradius = 8\n"
      "group = \"wall\"\n[[collide]]\nbetween = [\"wall\", \"ball\"]\n[[contact_mark]]\n";
  EXPECT_EQ(pictureAt(contact, 1, 0.9).primitives.size(), 2U);
  EXPECT_GT(pictureAt(contact, 2, 0.0).primitives.size(), 2U);
}

TEST(Overlay, LayersGoBelowAndAboveTheBodies) {
  const std::string body = "[[body]]\ncenter = [50, 60]\nradius = 5\nvelocity = [200, 0]\nfill = \"red\"\n";
  for (const char* layer : {"behind", "front"}) {
    SceneSource source = sourceOf(body + "[[arrow]]\nlayer = \"" + layer + "\"\n");
    Picture picture;
    source.draw(picture);
    ASSERT_EQ(picture.primitives.size(), 2U) << layer;
    const bool behind = picture.primitives[0].kind == Primitive::Kind::Arrow;
    EXPECT_EQ(behind, std::string(layer) == "behind");
  }
}

/// Exercises in C++ have them, too.
TEST(Overlay, StagesHaveTheSameOverlays) {
  struct Flight : Exercise {
    GameObject ball{Vec2(100, 100), 20.0, Vec2(120, 0), Vec2(0, 90)};
    void start(Stage& stage) override {
      stage.addTrail(ball, {.length = 1.0});
      stage.addGhosts(ball, {.every = 0.5});
      stage.addArrow(ball);
      stage.addArrow(ball, {.quantity = ArrowQuantity::Acceleration});
      stage.addMark(ball);
      stage.addOutline(ball);
      stage.addGrid({.step = 100.0, .color = {0, 0, 0, 0.2}});
    }
    void frame(Stage& /*stage*/, double dt) override { ball.update(dt); }
  };
  StageSource source(std::make_unique<Flight>(), {});
  Picture picture;
  for (int i = 0; i < 61; ++i) source.step();
  source.draw(picture);
  const auto count = [&](Primitive::Kind kind) {
    return std::ranges::count(picture.primitives, kind, &Primitive::kind);
  };
  EXPECT_EQ(count(Primitive::Kind::Arrow), 2);
  EXPECT_EQ(count(Primitive::Kind::Disc), 4);   // three ghosts and the ball
  EXPECT_GE(count(Primitive::Kind::Strip), 16); // one a step of the fading
  EXPECT_EQ(count(Primitive::Kind::Ring), 1);
}

/// What a scene's texts consist of: where each letter stands, and how large it is.
std::vector<std::array<double, 4>> lettersOf(const std::string& text, double time = 0.0) {
  SceneSource source = sourceOf(text);
  source.show({.moment = {static_cast<std::int64_t>(std::lround(60.0 * time)), 0.0}, .time = time});
  Picture picture;
  source.draw(picture);
  std::vector<std::array<double, 4>> letters;
  for (const Primitive& primitive : picture.primitives)
    if (primitive.kind == Primitive::Kind::Mask)
      letters.push_back({primitive.low.x(), primitive.low.y(), primitive.high.x(), primitive.high.y()});
  return letters;
}

std::string cameraTo(const std::string& center, double zoom) {
  return fmt::format("[[camera]]\nat = 0\nfor = 0\ncenter = {}\nzoom = {}\n", center, zoom);
}

/// Those of a grid that lies there by itself: at the lines in sight, at the frame's edge where no axis is.
TEST(Overlay, ACamerasGridHasItsNumbersAtTheLinesInSight) {
  struct Case {
    const char* center;
    double zoom;
    const char* view;
  };
  for (const Case& each : {Case{"[300, 200]", 2.0, "pixels_per_metre = 2\norigin = [-280, -160]"},
                           Case{"[900, 500]", 1.0, "pixels_per_metre = 1\norigin = [-580, -260]"},
                           Case{"[300, 200]", 0.5, "pixels_per_metre = 0.5\norigin = [170, 140]"},
                           Case{"[-250, 130]", 4.0, "pixels_per_metre = 4\norigin = [1320, -280]"}}) {
    const std::string grid = "duration = 1\n[grid]\nstep = 100\n";
    const auto moved = lettersOf(grid + cameraTo(each.center, each.zoom));
    const auto still = lettersOf(grid + "[view]\n" + each.view + "\n");
    EXPECT_GE(moved.size(), 6U) << each.view;
    EXPECT_EQ(moved, still) << each.view;
  }
}

/// px of the frame: around a ruler's length.
struct Label {
  Vec2 low, high;
};
Label labelOf(const std::string& text, double time) {
  Label label{Vec2::Constant(1e9), Vec2::Constant(-1e9)};
  for (const auto& [left, top, right, bottom] : lettersOf(text, time)) {
    label.low = label.low.cwiseMin(Vec2(left, top));
    label.high = label.high.cwiseMax(Vec2(right, bottom));
  }
  return label;
}

TEST(Overlay, ACamerasRulerHasItsLengthBesideItAtItsSize) {
  const std::string bodies = "duration = 1\n[[body]]\nname = \"ball\"\ncenter = [300, 250]\nradius = 10\n"
                             "velocity = [200, 0]\n";
  struct Case {
    const char* to;
    Vec2 middle; ///< px of the pane at 0.5 s
  };
  for (const Case& ruler : {Case{"[400, 250]", {325.0, 250.0}}, Case{"\"ball\"", {325.0, 250.0}}}) {
    const std::string scene = bodies + "[[ruler]]\nfrom = [250, 250]\nto = " + ruler.to + "\nunit = \"px\"\n";
    const Label plain = labelOf(scene, 0.5);
    for (const double zoom : {0.5, 1.0, 2.0}) {
      const Label moved = labelOf(scene + cameraTo("[300, 200]", zoom), 0.5);
      const Vec2 line = (ruler.middle - Vec2(300, 200)) * zoom + Vec2(320, 240);
      EXPECT_NEAR(0.5 * (moved.low.x() + moved.high.x()), line.x(), 2.0) << ruler.to << " at " << zoom;
      // Above the ticks, which the camera makes longer.
      EXPECT_NEAR(line.y() - 9.0 * zoom - moved.high.y(), 250.0 - 9.0 - plain.high.y(), 1.5)
          << ruler.to << " at " << zoom;
      EXPECT_NEAR(moved.high.x() - moved.low.x(), plain.high.x() - plain.low.x(), 2.0) << zoom;
      EXPECT_NEAR(moved.high.y() - moved.low.y(), plain.high.y() - plain.low.y(), 1.0) << zoom;
    }
  }
}

/// A ruler of 200 px around the frame's middle, `angle` from the x axis.
struct Ruler {
  Vec2 ahead;
  Vec2 from;
  std::string text; ///< its table without further keys
  explicit Ruler(double angle)
      : ahead(std::cos(angle), std::sin(angle)), from(Vec2(Vec2(320.0, 240.0) - 100.0 * ahead)) {
    const Vec2 to = from + 200.0 * ahead;
    text = fmt::format("duration = 1\n[[ruler]]\nfrom = [{:.17g}, {:.17g}]\nto = [{:.17g}, {:.17g}]\n",
                       from.x(), from.y(), to.x(), to.y());
  }
  [[nodiscard]] Vec2 aside() const { return {-ahead.y(), ahead.x()}; }
};

constexpr double kDegree = 3.14159265358979323846 / 180.0;

TEST(Overlay, ARulersLengthIsClearOfItsTicksAtEveryAngle) {
  for (const double width : {2.0, 6.0}) {
    for (int degrees = 0; degrees < 360; degrees += 5) {
      const Ruler ruler(degrees * kDegree);
      const std::string scene = ruler.text + "unit = \"px\"\nwidth = " + std::to_string(width) + "\n";
      const double ticks = 9.0 * width / 2.0;
      double nearest = 1e9;
      for (const auto& [left, top, right, bottom] : lettersOf(scene))
        for (const Vec2& corner :
             {Vec2(left, top), Vec2(left, bottom), Vec2(right, top), Vec2(right, bottom)})
          nearest = std::min(nearest, std::abs((corner - ruler.from).dot(ruler.aside())));
      EXPECT_GE(nearest, ticks + 2.0) << degrees << " degrees, width " << width;
      EXPECT_LE(nearest, ticks + 14.0) << degrees << " degrees, width " << width;
    }
  }
}

TEST(Overlay, ARulersLengthIsOnItsOtherSideWhereItWouldLeaveThePane) {
  const auto label = [](const std::string& from, const std::string& to) {
    return labelOf("duration = 1\n[[ruler]]\nunit = \"px\"\nfrom = " + from + "\nto = " + to + "\n", 0.0);
  };
  const Label top = label("[100, 12]", "[300, 12]");
  EXPECT_GT(top.low.y(), 12.0 + 9.0);
  EXPECT_NEAR(0.5 * (top.low.x() + top.high.x()), 200.0, 3.0);
  const Label right = label("[620, 100]", "[620, 300]");
  EXPECT_LT(right.high.x(), 620.0 - 9.0);
  EXPECT_LT(label("[100, 60]", "[300, 60]").high.y(), 60.0 - 9.0) << "as long as it has room";
  EXPECT_LT(label("[100, 470]", "[300, 470]").high.y(), 470.0 - 9.0);
  EXPECT_GT(label("[560, 100]", "[560, 300]").low.x(), 560.0 + 9.0);
}

/// From a tick's tip over the line to its other tip there is ink, also where the two meet, and also at the
/// ends.
TEST(Overlay, RulersAndTheirTicksJoinWithoutGaps) {
  for (const double width : {2.0, 4.0, 8.0}) {
    for (const double alpha : {1.0, 0.5}) {
      for (const double degrees : {0.0, 90.0, 17.0, 45.0, 63.0, 200.0}) {
        const Ruler ruler(degrees * kDegree);
        SceneSource source =
            sourceOf(ruler.text + fmt::format("width = {}\nstep = 40\ncolor = \"#000000{:02x}\"\n", width,
                                              static_cast<int>(alpha * 255.0)));
        Picture picture;
        source.draw(picture);
        const Frame frame = drawOnce(picture);
        for (const double at : {0.0, 40.0, 80.0, 200.0}) {
          const double reach = (at == 0.0 || at == 200.0 ? 9.0 : 5.0) * std::max(width / 2.0, 1.0) - 1.5;
          // Along the tick's middle, and near its outer side at an end.
          const double outer = at == 0.0 ? 1.2 - 0.5 * width : at == 200.0 ? 0.5 * width - 1.2 : 0.0;
          for (int quarter = 0; 0.25 * quarter <= 2.0 * reach; ++quarter) {
            const double across = 0.25 * quarter - reach;
            const Vec2 place =
                ruler.from + (at + (width > 2.0 ? outer : 0.0)) * ruler.ahead + across * ruler.aside();
            const int x = static_cast<int>(std::floor(place.x()));
            const int y = static_cast<int>(std::floor(place.y()));
            const Vec2 middle = Vec2(x + 0.5, y + 0.5) - ruler.from - at * ruler.ahead;
            const double room = 0.5 * width - std::abs(middle.dot(ruler.ahead));
            if (room < 0.71) continue; // at the tick's side
            const double ink = 1.0 - pixel(frame, x, y).r / 255.0;
            ASSERT_GT(ink, 0.92 * alpha) << "width " << width << ", " << degrees << " degrees, tick at " << at
                                         << ", across " << across;
            ASSERT_LT(ink, alpha + 0.14) << "width " << width << ", " << degrees << " degrees, tick at " << at
                                         << ", across " << across;
          }
        }
      }
    }
  }
}

TEST(Overlay, TellsWhatIsWrong) {
  const auto errors =
      errorsOf("[[trail]]\nof = \"nobody\"\nlength = -1\n[[ghost]]\nfade = true\n"
               "[[ruler]]\nfrom = [0, 0]\nto = [100, 0]\nstep = 0.0001\n[grid]\nstep = nan\n");
  EXPECT_THAT(
      errors,
      ::testing::ElementsAre(
          ::testing::HasSubstr("scene.toml:2:6: error: 'of' in [[trail]] names \"nobody\", which is "
                               "neither a body nor a group"),
          ::testing::HasSubstr("scene.toml:3:10: error: 'length' in [[trail]] must be greater than 0"),
          ::testing::HasSubstr("scene.toml:5:8: error: 'fade' in [[ghost]] needs a 'length'"),
          ::testing::HasSubstr("scene.toml:9:8: error: 'step' in [[ruler]] gives more than 2000 lines"),
          ::testing::HasSubstr("scene.toml:11:8: error: 'step' in [grid] must be")));
}

} // namespace
} // namespace offstage::test
