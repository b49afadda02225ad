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
  text += " | " + dump(s.restitution.value_or(ConstantNumber{s.prototype.restitution}));
  return text + " | " + dump(s.friction.value_or(ConstantNumber{s.prototype.friction}));
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

std::string dump(const Color& color) {
  return dump(Paint(color));
}

std::string dump(const std::optional<Color>& color) {
  return color ? dump(*color) : "default";
}

std::string dump(const BodySelection& of) {
  return fmt::format("of {} {} {}", of.all, fmt::join(of.bodies, ","), fmt::join(of.groups, ","));
}

std::string dump(const Overlays& o) {
  std::string text = fmt::format("\nunits {} {} {}", o.units.pixels, dump(o.units.origin), o.units.yUp);
  const auto layer = [](OverlayLayer which) { return static_cast<int>(which); };
  for (const GridOverlay& g : o.grids)
    text += fmt::format("\ngrid {} {} {} {} {} {} {} {}", g.step, g.width, dump(g.color), g.axes,
                        dump(g.axisColor), g.labels, g.labelSize, layer(g.layer));
  for (const TrailOverlay& t : o.trails)
    text += fmt::format("\ntrail {} {} {} {} {} {} {}", dump(t.of), t.length, t.width, dump(t.color),
                        t.opacity, t.fade, layer(t.layer));
  for (const GhostOverlay& g : o.ghosts)
    text += fmt::format("\nghost {} {} {} {} {} {}", dump(g.of), g.every, g.length, g.opacity, g.fade,
                        layer(g.layer));
  for (const OutlineOverlay& l : o.outlines)
    text +=
        fmt::format("\noutline {} {} {} {} {}", dump(l.of), l.margin, l.width, dump(l.color), layer(l.layer));
  for (const MarkOverlay& m : o.marks)
    text += fmt::format("\nmark {} {} {} {} {} {}", dump(m.of), static_cast<int>(m.shape), m.size, m.width,
                        dump(m.color), layer(m.layer));
  for (const ArrowOverlay& a : o.arrows)
    text += fmt::format("\narrow {} {} {} {} {} {} {}", dump(a.of), static_cast<int>(a.quantity), a.scale,
                        a.width, dump(a.color), a.opacity, layer(a.layer));
  for (const ContactMarkOverlay& m : o.contactMarks)
    text += fmt::format("\ncontact mark {} {} {} {} {} {} {}", dump(m.of), m.duration, m.length, m.width,
                        dump(m.normal), dump(m.tangent), layer(m.layer));
  for (const RulerOverlay& r : o.rulers)
    text += fmt::format("\nruler {} {} {} {} {} {} {} {}", dump(r.from), dump(r.to), r.step, r.width,
                        dump(r.color), r.unit, r.labelSize, layer(r.layer));
  return text;
}

std::string dump(const Probe& p) {
  return fmt::format("{}/{}/{}/{}/{}/{}", static_cast<int>(p.quantity), p.body.value_or(77),
                     p.group.value_or(77), p.other, p.zero, p.unit);
}

std::string dump(const PlotAxis& axis) {
  return fmt::format("{} {} {}", axis.label,
                     axis.range ? fmt::format("{}", fmt::join(*axis.range, "..")) : "auto", axis.log);
}

std::string dump(const Plot& p) {
  std::string text = fmt::format("\nplot {} | {} | {} {} {} {} {} {} {} {} {} {}", dump(p.x), dump(p.y),
                                 fmt::join(p.area, ","), p.title, p.textSize, p.width, p.whole, p.cursor,
                                 p.grid, p.legend, p.overTime, dump(p.background));
  for (const PlotCurve& curve : p.curves)
    text += fmt::format(" | {} {} {} {}", dump(curve.x), dump(curve.y), curve.name, dump(curve.color));
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

std::string dump(const std::optional<SoundFile>& sound) {
  return sound ? sound->file.filename().string() : "none";
}

std::string dump(const Timeline& timeline) {
  std::string text = fmt::format("\ntimeline {} {} {} | narration {} {} | clicks {} {} | poster {}",
                                 timeline.fadeIn, timeline.fadeOut, dump(Paint(timeline.fadeColor)),
                                 dump(timeline.narration), timeline.narrationStart, timeline.clicks,
                                 timeline.loudestClick, timeline.poster.value_or(-1.0));
  for (const Section& s : timeline.sections)
    text += fmt::format("\nsection {} {} {} {} {}", s.title, s.start, s.card, s.subtitle, dump(s.narration));
  for (const Caption& c : timeline.captions)
    text += fmt::format("\ncaption {} {} {} {}", c.text, c.from, c.to, c.section ? "in a section" : "");
  for (const EventCaption& c : timeline.eventCaptions) {
    text += fmt::format("\ncaption {} {} {} {}", c.text, c.length, c.limit.value_or(-1), c.body ? 1 : 0);
    for (const EventKind kind : c.kinds) text += fmt::format(" {}", name(kind));
  }
  for (const Pause& p : timeline.pauses)
    text += fmt::format("\npause {} {} {} {} {}", p.at, p.length, p.bodies.size(),
                        static_cast<int>(p.highlight), dump(Paint(p.color)));
  for (const SpeedChange& s : timeline.speeds)
    text += fmt::format("\nspeed {} {} {}", s.from, s.to, s.factor);
  for (const CameraMove& m : timeline.camera)
    text += fmt::format("\ncamera {} {} {} {} {} {}", m.at, m.length, dump(m.center), m.zoom,
                        static_cast<int>(m.easing), m.section ? "in a section" : "");
  return text;
}

std::string dump(const TextItem& item) {
  const TextLook& look = item.look;
  std::string text =
      fmt::format("at {} place {} offset {} from {} to {} fade {} size {} font {} {} color {} opacity {} "
                  "anchor {} align {} "
                  "line {} background {} {} outline {} {} upwards {}:",
                  dump(item.at), item.place ? static_cast<int>(*item.place) : -1, dump(item.offset),
                  item.from, item.to, item.fade, look.size, static_cast<int>(look.font.typeface),
                  look.font.file.string(), dump(Paint(look.color)), look.opacity,
                  static_cast<int>(look.anchor), static_cast<int>(look.align), look.lineHeight,
                  dump(look.background), look.padding, dump(look.outline), look.outlineWidth, look.upwards);
  text += item.formula;
  for (const TextTemplate::Piece& piece : item.text.pieces)
    text += fmt::format(" {} {}", piece.text, piece.probe ? static_cast<int>(piece.probe->quantity) : -1);
  return text;
}

} // namespace

std::string dump(const Scene& scene) {
  const WorldSetup& world = scene.world;
  std::string text = fmt::format("title {}\nsize {} background {} scale {}\nclock {} {} {}\n", scene.title,
                                 fmt::join(scene.size, "x"), dump(Paint(scene.background)), scene.scale,
                                 scene.clock.fps(), scene.clock.steps(), scene.clock.duration());
  text +=
      fmt::format("pane {} gravity {} seed {} step {} {} substeps {} contacts {} {} groups {}\nwalls {}",
                  dump(world.pane), dump(world.gravity), world.seed, static_cast<int>(world.stepping.form),
                  world.stepping.dt, world.substeps, static_cast<int>(world.contactModel), world.iterations,
                  fmt::join(world.groups, ","), world.walls.clamp);
  text += fmt::format(" expect {}", fmt::join(scene.expectedWarnings, ","));
  for (const auto& side : world.walls.restitution) text += side ? fmt::format(" {}", *side) : " open";
  for (const Look& look : scene.looks) text += "\nlook " + dump(look);
  for (const Body& body : world.bodies) text += "\nbody " + scene.bodyNames.at(body.id) + ' ' + dump(body);
  for (const Spawner& spawner : world.spawners) text += "\nspawn " + dump(spawner);
  for (const Launch& launch : world.launches) text += "\nlaunch " + dump(launch);
  text += fmt::format("\ntheme {} {} {} {} {}", scene.theme.bodies, dump(Paint(scene.theme.background)),
                      dump(Paint(scene.theme.text)), dump(Paint(scene.theme.muted)),
                      dump(Paint(scene.theme.grid)));
  for (const Color& color : scene.theme.palette) text += ' ' + dump(Paint(color));
  for (const TextItem& item : scene.texts) text += "\ntext " + dump(item);
  for (const ContactRule& rule : world.contacts) {
    text +=
        fmt::format("\ncollide {} {} {} {} {} {}", rule.groupA, rule.groupB, static_cast<int>(rule.response),
                    rule.restitution, rule.separate, rule.approachingOnly);
  }
  for (const Force& force : world.forces) text += "\nforce " + dump(force);
  text += dump(scene.overlays);
  for (const Plot& plot : scene.plots) text += dump(plot);
  if (!scene.panels.panels.empty()) {
    text += fmt::format("\npanels {} {} {} {}", static_cast<int>(scene.panels.layout), scene.panels.columns,
                        scene.panels.gap, scene.panels.caption);
    for (const PanelPlot& each : scene.panels.plots) {
      text += dump(each.plot);
      for (const std::size_t panel : each.panels) text += fmt::format(" of {}", panel);
    }
    for (const Panel& panel : scene.panels.panels)
      text += fmt::format("\npanel {} {}\n{}", panel.title, dump(panel.color), dump(*panel.scene));
  }
  text += dump(scene.timeline);
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
