#include "tests/support/scene_dump.h"

#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace offstage::test {
namespace {

std::string dump(const Vec2& v) {
  return fmt::format("[{}, {}]", v.x(), v.y());
}

std::string dump(const Paint& paint) {
  if (const auto* color = std::get_if<Color>(&paint)) {
    return fmt::format("#{:02x}{:02x}{:02x}/{}", color->red, color->green, color->blue, color->alpha);
  }
  const auto& pattern = std::get<ImagePattern>(paint);
  return fmt::format("{} {} {}", pattern.file.string(), fmt::join(pattern.anchor, ","), pattern.proportional);
}

std::string dump(const Look& look) {
  std::string text = fmt::format("fill {} opacity {}", look.fill ? dump(*look.fill) : "none", look.opacity);
  if (look.stroke) {
    text += fmt::format(" stroke {} {} {}", dump(look.stroke->paint), look.stroke->width,
                        static_cast<int>(look.stroke->align));
  }
  return text;
}

std::string dump(const Body& b) {
  return fmt::format(
      "id {} group {} look {} shape {} integrator {} gravity {} fixed {} leaves {} x {} v {} a {} r {} "
      "size {} m {} e {} f {} continuous {}",
      b.id, b.group, b.look, static_cast<int>(b.shape), static_cast<int>(b.integrator), b.feelsGravity,
      b.fixed, b.removedOutside, dump(b.position), dump(b.velocity), dump(b.acceleration), b.radius,
      dump(b.size), b.mass, b.restitution, b.friction, b.continuous);
}

std::string dump(const Number& number) {
  struct Dump {
    std::string operator()(const ConstantNumber& n) const { return fmt::format("{}", n.value); }
    std::string operator()(const IntegerNumber& n) const { return fmt::format("int {}", n.bound); }
    std::string operator()(const SpreadNumber& n) const { return fmt::format("spread {}", n.half); }
    std::string operator()(const UniformNumber& n) const {
      return fmt::format("uniform {} {}", n.low, n.high);
    }
    std::string operator()(const GaussianNumber& n) const {
      return fmt::format("gaussian {} {}", n.mean, n.deviation);
    }
  };
  return std::visit(Dump{}, number);
}

std::string dump(const Spawner& s) {
  std::string text = fmt::format("every {} count {} when {} limit {} looks {} prototype {}", s.every,
                                 static_cast<int>(s.count), static_cast<int>(s.when), s.limit.value_or(-1),
                                 fmt::join(s.looks, ","), dump(s.prototype));
  for (const Number* number :
       {&s.x, &s.y, &s.radius, &s.width, &s.height, &s.vx, &s.vy, &s.ax, &s.ay, &s.mass}) {
    text += " | " + dump(*number);
  }
  return text;
}

std::string dump(const Anchor& anchor) {
  return anchor.body ? fmt::format("body {}", *anchor.body) : dump(anchor.point);
}

std::string dump(const Launch& launch) {
  std::string text = fmt::format("from {} toward {} speed {} prototype {}", dump(launch.from),
                                 dump(launch.toward), launch.speed, dump(launch.prototype));
  for (const auto& moment : launch.moments)
    text += fmt::format(" at {}/{}", moment.frame.value_or(-1), moment.time);
  return text;
}

std::string dump(const Force& force) {
  struct Dump {
    std::string operator()(const DragForce& f) const {
      return fmt::format("drag {} {}", f.linear, f.quadratic);
    }
    std::string operator()(const SpringForce& f) const {
      return fmt::format("spring {} {} {} {}", dump(f.to), f.stiffness, f.length, f.damping);
    }
    std::string operator()(const AttractForce& f) const {
      return fmt::format("attract {} {} {}", dump(f.to), f.strength, f.softening);
    }
    std::string operator()(const WindForce& f) const {
      return fmt::format("wind {} {}", dump(f.velocity), f.coefficient);
    }
    std::string operator()(const CustomForce& f) const {
      return fmt::format("custom {} {}", dump(f.evaluate({{1.5, 2.5}, {3.5, 4.5}, 5.5, 6.5})),
                         dump(f.evaluate({{-1.0, 20.0}, {0.0, -4.0}, 0.25, 1.0})));
    }
  };
  return fmt::format("{} group {} body {}", std::visit(Dump{}, force.kind),
                     force.group ? fmt::format("{}", *force.group) : "all",
                     force.body ? fmt::format("{}", *force.body) : "all");
}

} // namespace

std::string dump(const Scene& scene) {
  const WorldSetup& world = scene.world;
  std::string text = fmt::format("title {}\nsize {} background {} scale {}\nclock {} {} {}\n", scene.title,
                                 fmt::join(scene.size, "x"), dump(Paint(scene.background)), scene.scale,
                                 scene.clock.fps(), scene.clock.steps(), scene.clock.duration());
  text += fmt::format("pane {} gravity {} seed {} substeps {} contacts {} {} groups {}\nwalls {}",
                      dump(world.pane), dump(world.gravity), world.seed, world.substeps,
                      static_cast<int>(world.contactModel), world.iterations, fmt::join(world.groups, ","),
                      world.walls.clamp);
  for (const auto& side : world.walls.restitution) text += side ? fmt::format(" {}", *side) : " open";
  for (const Look& look : scene.looks) text += "\nlook " + dump(look);
  for (const Body& body : world.bodies) text += "\nbody " + scene.bodyNames.at(body.id) + ' ' + dump(body);
  for (const Spawner& spawner : world.spawners) text += "\nspawn " + dump(spawner);
  for (const Launch& launch : world.launches) text += "\nlaunch " + dump(launch);
  for (const ContactRule& rule : world.contacts) {
    text +=
        fmt::format("\ncollide {} {} {} {} {} {}", rule.groupA, rule.groupB, static_cast<int>(rule.response),
                    rule.restitution, rule.separate, rule.approachingOnly);
  }
  for (const Force& force : world.forces) text += "\nforce " + dump(force);
  if (scene.golden) {
    const Tolerance& t = scene.golden->tolerance;
    text += fmt::format("\ngolden {} | {} {} {} {} {} {} {} {} {}", fmt::join(scene.golden->at, " "),
                        t.maxChannel.value_or(0.0), t.maxPixels.value_or(-1), t.maxRatio.value_or(-1.0),
                        t.maxCluster.value_or(-1), t.flipMax.value_or(-1.0), t.ssimMin.value_or(-2.0),
                        t.maxForgiven.value_or(-1), t.ignoreAntialiasing, t.strictAlpha);
    for (const IgnoredRegion& region : t.ignore)
      text += fmt::format(" {} {} {} {}", region.x, region.y, region.width, region.height);
    for (const std::filesystem::path& mask : t.masks) text += " " + mask.string();
  }
  if (scene.replay) {
    for (const Replay::Frame& frame : scene.replay->frames)
      text += fmt::format("\nreplay {} {}+{}", frame.time, frame.first, frame.count);
    text += fmt::format("\nlooks {}", fmt::join(scene.replay->looks, " "));
  }
  return text;
}

} // namespace offstage::test
