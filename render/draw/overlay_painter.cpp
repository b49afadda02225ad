#include "render/draw/overlay_painter.h"

#include "render/draw/axis.h"
#include "render/draw/camera.h"
#include "render/draw/pen.h"
#include "render/draw/simplify.h"
#include "src/scene/palette.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

namespace offstage {
namespace {

constexpr double kHeadPerWidth = 4.0; ///< an arrow's head in widths of its shaft
constexpr double kLeastArrow = 1.0;   ///< px: a shorter one is not drawn
constexpr double kTick = 5.0;         ///< px to either side of a ruler of the usual width or a thinner one
constexpr double kLongTick = 9.0;     ///< px: every fifth, and the ends
constexpr double kUsualRuler = 2.0;   ///< px wide; of a wider one the ticks are longer in proportion
constexpr double kMostTicks = 2000.0;
constexpr double kRounding = 1e-9; ///< s: what is due at a moment up to rounding is due

Rgba8 bytes(const Color& color, double opacity = 1.0) {
  return {color.red, color.green, color.blue, color.alphaByte(opacity)};
}

Vec2 toOutput(const Viewport& viewport, const Vec2& p) {
  return p * viewport.scale + viewport.offset;
}

/// The nearest place at which an axis-parallel line of whole pixels' width is sharp.
double sharp(double at, double width) {
  return std::round(at - 0.5 * width) + 0.5 * width;
}

Vec2 middleOf(const Body& body) {
  return centre(body, body.position);
}

void drawMark(Picture& picture, const MarkOverlay& mark, const Body& body, const Viewport& viewport) {
  const Vec2 at = toOutput(viewport, middleOf(body));
  const double reach = 0.5 * mark.size * viewport.scale;
  Pen pen(picture, mark.width * viewport.scale, bytes(mark.color.value_or(Color{})));
  if (mark.shape == MarkOverlay::Shape::Dot) {
    pen.disc(at, reach);
    return;
  }
  // Two strokes of one translucent colour would be darker where they cross, so one is drawn in two halves.
  const double part = mark.shape == MarkOverlay::Shape::Cross ? std::sqrt(0.5) : 1.0;
  const Vec2 one = mark.shape == MarkOverlay::Shape::Cross ? Vec2(part, part) : Vec2(1.0, 0.0);
  const Vec2 two(-one.y(), one.x());
  const double half = 0.5 * mark.width * viewport.scale;
  pen.line(at - one * reach, at + one * reach);
  if (half >= reach) return;
  pen.line(at + two * half, at + two * reach);
  pen.line(at - two * half, at - two * reach);
}

void drawOutline(Picture& picture, const OutlineOverlay& outline, const Body& body,
                 const Viewport& viewport) {
  const double own = body.shape == Shape::Circle ? body.radius : 0.5 * length(body.size);
  const double radius = own + outline.margin;
  if (radius < 0.0) return;
  Pen(picture, outline.width * viewport.scale, bytes(outline.color.value_or(Color{})))
      .circle(toOutput(viewport, middleOf(body)), radius * viewport.scale);
}

/// Where an anchor is; nothing when its body is gone.
std::optional<Vec2> placeOf(const Anchor& anchor, std::span<const Body> bodies) {
  if (!anchor.body) return anchor.point;
  const auto body = std::ranges::find(bodies, *anchor.body, &Body::id);
  if (body == bodies.end()) return std::nullopt;
  return middleOf(*body);
}

constexpr double kTrailTolerance = 0.1; ///< px of the output that a trail may lie beside its places
constexpr double kTrailCosine = 0.9962; ///< of 5°: a pen's path does not show such a turn (pen_path.cpp)

/// How a trail fades: in steps of a part of its length, too small to be seen. Time is cut at whole multiples
/// of the step, and what lies between two cuts is of one colour. So all trails of one length fade at the same
/// moments, and between these only their heads change: hardly anything has to be drawn and encoded again.
/// Cuts and colours depend on the time alone, not on what was drawn before.
class TrailSteps {
public:
  explicit TrailSteps(double length)
      : count_(std::clamp(std::floor(length / kStep), kLeast, kMost)), length_(length / count_) {}

  [[nodiscard]] double of(double time) const { return std::floor(time / length_ + kOnCut); }
  /// s: where a fading trail begins.
  [[nodiscard]] double beginOf(double now) const { return (of(now) - count_ + 1.0) * length_; }
  /// What is left of the colour in a step: 0 … 1.
  [[nodiscard]] double shareIn(double step, double present) const {
    return std::clamp(1.0 - (present - step + 0.5) / count_, 0.0, 1.0);
  }

private:
  static constexpr double kStep = 0.125; ///< s
  static constexpr double kLeast = 16.0;
  static constexpr double kMost = 64.0;
  static constexpr double kOnCut = 1e-9; ///< a time on a cut up to rounding is on it
  double count_;
  double length_; ///< s: of a step
};

Vec2 toPane(const Viewport& viewport, const Vec2& p) {
  return (p - viewport.offset) / viewport.scale;
}

/// A ruler's: to the hundredth of a unit, or the pixel. A very large one in three digits.
std::string lengthLabel(double pixels, double unit) {
  const double shown = pixels / unit;
  return tickLabel(shown, std::max(unit > 1.0 ? 0.01 : 1.0, shown >= 1e6 ? 0.01 * shown : 0.0));
}

} // namespace

void OverlayPainter::paint(Picture& picture, OverlayLayer layer, const Now& now) const {
  const auto each = [layer](const auto& list, auto draw) {
    for (const auto& overlay : list)
      if (overlay.layer == layer) draw(overlay);
  };
  each(overlays_.grids, [&](const GridOverlay& overlay) { grid(picture, overlay, now); });
  each(overlays_.trails, [&](const TrailOverlay& overlay) { trail(picture, overlay, now); });
  for (std::size_t i = 0; i < overlays_.ghosts.size(); ++i)
    if (overlays_.ghosts[i].layer == layer) ghosts(picture, i, now);
  ofBodies(picture, layer, now, [](const Body&) { return true; });
  each(overlays_.contactMarks, [&](const ContactMarkOverlay& overlay) { contacts(picture, overlay, now); });
  each(overlays_.rulers, [&](const RulerOverlay& overlay) { ruler(picture, overlay, now); });
}

void OverlayPainter::paintOf(Picture& picture, std::span<const std::uint32_t> ids, const Now& now) const {
  ofBodies(picture, OverlayLayer::Front, now,
           [ids](const Body& body) { return std::ranges::count(ids, body.id) > 0; });
}

void OverlayPainter::ofBodies(Picture& picture, OverlayLayer layer, const Now& now,
                              const Chosen& chosen) const {
  const auto eachBody = [&](const auto& list, auto draw) {
    for (const auto& overlay : list) {
      if (overlay.layer != layer) continue;
      for (const Body& body : now.bodies)
        if (overlay.of.holds(body) && chosen(body)) draw(picture, overlay, body, now.painter.viewport());
    }
  };
  eachBody(overlays_.outlines, drawOutline);
  eachBody(overlays_.marks, drawMark);
  for (const ArrowOverlay& arrow : overlays_.arrows)
    if (arrow.layer == layer) arrows(picture, arrow, now, chosen);
}

void OverlayPainter::grid(Picture& picture, const GridOverlay& grid, const Now& now) const {
  const Viewport& viewport = now.painter.viewport();
  const PixelRect& pane = viewport.clip;
  const Vec2 origin = toOutput(viewport, overlays_.units.origin);
  const double step = grid.step * viewport.scale;
  if (!(step > 1.0)) return; // closer lines are a grey pane
  const Vec2 low(pane.left, pane.top);
  const Vec2 high(pane.right, pane.bottom);
  const double width = std::max(std::round(grid.width * viewport.scale), 1.0);
  const auto line = [&](Pen& pen, int axis, double at, double lineWidth) {
    Vec2 from = low;
    Vec2 to = high;
    from[axis] = to[axis] = sharp(at, lineWidth);
    pen.line(from, to);
  };
  Pen pen(picture, width, bytes(grid.color));
  Pen axisPen(picture, 2.0 * width, bytes(grid.axisColor));
  for (int axis = 0; axis < 2; ++axis) {
    for (double k = std::ceil((low[axis] - origin[axis]) / step); origin[axis] + k * step <= high[axis];
         k += 1.0) {
      if (grid.axes && k == 0.0) continue;
      line(pen, axis, origin[axis] + k * step, width);
    }
  }
  for (int axis = 0; axis < 2; ++axis)
    if (grid.axes) line(axisPen, axis, origin[axis], 2.0 * width);
  if (grid.labels) gridLabels(picture, grid, now);
}

/// Numbers beside the axes, or beside the frame's nearest edge where an axis is not in sight. Of lines that
/// stand closer than three em only every second, fifth or tenth … has one. All lengths are px of the frame: a
/// camera moves the lines, the numbers go with them and keep their size.
void OverlayPainter::gridLabels(Picture& picture, const GridOverlay& grid, const Now& now) const {
  const Viewport& frame = now.texts.viewport();
  const Viewport& camera = now.painter.viewport();
  const OverlayUnits& units = overlays_.units;
  const Vec2 origin = shownAt(units.origin, frame, camera);
  const double between = grid.step * (camera.scale / frame.scale);
  const Vec2 low = toPane(frame, Vec2(frame.clip.left, frame.clip.top));
  const Vec2 high = toPane(frame, Vec2(frame.clip.right, frame.clip.bottom));
  const double em = grid.labelSize;
  const double every = roundStep(std::max(3.0 * em / between, 1.0));
  const double step = grid.step / units.pixels;
  TextLook look;
  look.size = em;
  look.color = grid.axisColor;
  for (int axis = 0; axis < 2; ++axis) {
    const double across = std::clamp(origin[1 - axis], low[1 - axis], high[1 - axis]);
    // Below a horizontal axis and left of a vertical one, but inside the frame.
    const bool outside = axis == 0 ? across + 2.0 * em > high[1] : across - 3.0 * em < low[0];
    if (axis == 0) look.anchor = outside ? NinePosition::Bottom : NinePosition::Top;
    if (axis == 1) look.anchor = outside ? NinePosition::Left : NinePosition::Right;
    const double away = (axis == 0) == outside ? -0.4 * em : 0.4 * em;
    const double sign = axis == 1 && units.yUp ? -1.0 : 1.0;
    for (double k = std::ceil((low[axis] - origin[axis]) / between / every) * every;
         origin[axis] + k * between <= high[axis]; k += every) {
      const double at = origin[axis] + k * between;
      if (k == 0.0 || at < low[axis] + em || at > high[axis] - em) continue;
      Vec2 place;
      place[axis] = at;
      place[1 - axis] = across + away;
      now.texts.draw(picture, tickLabel(sign * k * step, every * step), look, place);
    }
  }
}

void OverlayPainter::trail(Picture& picture, const TrailOverlay& trail, const Now& now) const {
  const Viewport& viewport = now.painter.viewport();
  const TrailSteps steps(trail.length);
  const double present = steps.of(now.time);
  const double begin = trail.fade ? steps.beginOf(now.time) : now.time - trail.length;
  std::vector<Vec2> points;
  std::vector<Rgba8> colors;
  PathSimplifier path(kTrailTolerance, kTrailCosine); // of the step being gone through
  for (const auto& [id, track] : now.history.tracks()) {
    if (!trail.of.holds(id, track.group)) continue;
    const Rgba8 color = trail.color ? bytes(*trail.color, trail.opacity)
                                    : faded(now.painter.colorOf(track.look), trail.opacity);
    points.clear();
    colors.clear();
    path.clear();
    double step = 0.0;
    const auto endStep = [&] {
      if (!points.empty()) points.pop_back(); // the step before ends where this one begins
      path.appendTo(points);
      colors.resize(points.size() - 1, trail.fade ? faded(color, steps.shareIn(step, present)) : color);
    };
    const auto add = [&](const OverlayHistory::Place& place) {
      const Vec2 at = toOutput(viewport, place.at);
      const double own = steps.of(place.time);
      if (path.empty()) {
        step = own;
      } else if (own != step) { // the first place of a step also ends the one before
        path.add(at);
        endStep();
        path.clear();
        step = own;
      }
      path.add(at);
    };
    const auto& places = track.places;
    const auto first = std::ranges::lower_bound(places, begin, {}, &OverlayHistory::Place::time);
    if (first != places.begin()) { // it begins on the way from the place before
      const OverlayHistory::Place& from = *std::prev(first);
      const OverlayHistory::Place& to = first != places.end() ? *first : track.head;
      if (to.time > begin) {
        const double part = (begin - from.time) / (to.time - from.time);
        add({begin, from.at + part * (to.at - from.at)});
      }
    }
    for (auto place = first; place != places.end() && place->time <= now.time; ++place) add(*place);
    OverlayHistory::Place last = track.head;
    if (last.time > now.time) { // between two frames, of which the history knows both
      const auto body = std::ranges::lower_bound(now.bodies, id, {}, &Body::id); // in order of creation
      if (body == now.bodies.end() || body->id != id) continue;
      last = {now.time, middleOf(*body)};
    }
    if (last.time > begin) add(last);
    if (path.empty()) continue;
    endStep();
    // Under a living body, and where a trail has faded, a round end is not seen.
    Pen(picture, trail.width * viewport.scale, color)
        .path(points, colors, {.roundFirst = !trail.fade, .roundLast = last.time < now.time});
  }
}

void OverlayPainter::ghosts(Picture& picture, std::size_t index, const Now& now) const {
  const GhostOverlay& overlay = overlays_.ghosts[index];
  for (const OverlayHistory::Ghost& ghost : now.history.ghosts(index)) {
    if (ghost.time > now.time + kRounding || ghost.time < now.time - overlay.length - kRounding) continue;
    const double left = overlay.fade ? 1.0 - (now.time - ghost.time) / overlay.length : 1.0;
    now.painter.body(picture, ghost.body, ghost.body.look, overlay.opacity * std::clamp(left, 0.0, 1.0));
  }
}

std::vector<Vec2> OverlayPainter::accelerations(std::span<const Body> bodies, double time) const {
  ForceField field = field_;
  field.findAnchors(bodies);
  std::vector<Motion> everyone;
  for (const Body& body : bodies) everyone.push_back({body.position, body.velocity});
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    result.push_back(field.acceleration(bodies, i, everyone[i], time, everyone));
  return result;
}

void OverlayPainter::arrows(Picture& picture, const ArrowOverlay& arrow, const Now& now,
                            const Chosen& chosen) const {
  const Viewport& viewport = now.painter.viewport();
  const Color color = arrow.color.value_or(arrowColor(arrow.quantity));
  Pen pen(picture, arrow.width * viewport.scale, bytes(color, arrow.opacity));
  std::vector<Vec2> accelerated;
  if (arrow.quantity != ArrowQuantity::Velocity) accelerated = accelerations(now.bodies, now.time);
  for (std::size_t i = 0; i < now.bodies.size(); ++i) {
    const Body& body = now.bodies[i];
    if (body.fixed || !arrow.of.holds(body) || !chosen(body)) continue;
    Vec2 value = body.velocity;
    if (arrow.quantity == ArrowQuantity::Acceleration) value = accelerated[i];
    if (arrow.quantity == ArrowQuantity::Force) value = accelerated[i] * body.mass;
    const Vec2 shown = value * (arrow.scale * viewport.scale);
    if (!(length(shown) >= kLeastArrow)) continue;
    const Vec2 from = toOutput(viewport, middleOf(body));
    pen.arrow(from, from + shown, kHeadPerWidth * arrow.width * viewport.scale);
  }
}

void OverlayPainter::contacts(Picture& picture, const ContactMarkOverlay& mark, const Now& now) const {
  const Viewport& viewport = now.painter.viewport();
  const double width = mark.width * viewport.scale;
  for (const OverlayHistory::Contact& contact : now.history.contacts()) {
    const double left = 1.0 - (now.time - contact.time) / mark.duration;
    if (contact.time > now.time + kRounding || !(left > 0.0) ||
        !(mark.of.holds(contact.first) || mark.of.holds(contact.second)))
      continue;
    const double opacity = std::min(2.0 * left, 1.0);
    const Vec2 at = toOutput(viewport, contact.at);
    const Vec2 along = contact.normal * (0.5 * mark.length * viewport.scale);
    const Vec2 across(-along.y(), along.x());
    Pen pen(picture, width, bytes(mark.tangent, opacity));
    pen.dashes(at - across, at + across, 3.0 * width, 2.0 * width);
    pen.setColor(bytes(mark.normal, opacity));
    pen.arrow(at - along, at + along, kHeadPerWidth * width);
    pen.disc(at, 2.0 * width);
  }
}

void OverlayPainter::ruler(Picture& picture, const RulerOverlay& ruler, const Now& now) const {
  const Viewport& viewport = now.painter.viewport();
  const auto from = placeOf(ruler.from, now.bodies);
  const auto to = placeOf(ruler.to, now.bodies);
  if (!from || !to || !(length(*to - *from) > 0.0)) return;
  const double whole = length(*to - *from);
  const Vec2 ahead = (*to - *from) / whole;
  const Vec2 aside = Vec2(-ahead.y(), ahead.x()) * viewport.scale;
  const double half = 0.5 * ruler.width;
  const double longer = std::max(ruler.width / kUsualRuler, 1.0);
  Pen pen(picture, ruler.width * viewport.scale, bytes(ruler.color));
  // As far as the outer sides of the ticks at its ends.
  pen.line(toOutput(viewport, *from - ahead * half), toOutput(viewport, *to + ahead * half));
  // Ticks stand on the line and not across it, where a translucent one would show twice. Where an edge of the
  // line lies within pixels, a tick begins half a pixel inside it: else both edges let the background
  // through.
  const auto side = [&](const Vec2& at, const Vec2& outward, double reach) {
    const Vec2 foot = at + outward * half;
    const int axis = std::abs(outward.x()) > std::abs(outward.y()) ? 0 : 1;
    const bool onEdge = outward[1 - axis] == 0.0 && std::abs(foot[axis] - std::round(foot[axis])) < 1e-6;
    pen.line(onEdge ? foot : Vec2(foot - outward * (0.5 / viewport.scale)), at + outward * reach);
  };
  const auto tick = [&](double distance, double reach) {
    const Vec2 at = toOutput(viewport, *from + ahead * distance);
    side(at, aside, reach * longer);
    side(at, -aside, reach * longer);
  };
  tick(0.0, kLongTick);
  tick(whole, kLongTick);
  // None that would lie on the one at the end.
  const double last = whole - std::max(ruler.width, 1e-6 * ruler.step) * (1.0 - 1e-9);
  for (double k = 1.0; k * ruler.step < last && k <= kMostTicks; k += 1.0)
    tick(k * ruler.step, std::fmod(k, 5.0) == 0.0 ? kLongTick : kTick);
  if (!ruler.unit.empty()) rulerLength(picture, ruler, {*from, *to}, now);
}

/// Beside the ruler's middle, above it or, where it is steep, to the right: so far away that the text's box
/// is clear of the ticks. On the other side where only there it is in the pane. A camera makes the ticks
/// longer, and not the text.
void OverlayPainter::rulerLength(Picture& picture, const RulerOverlay& ruler, const std::array<Vec2, 2>& ends,
                                 const Now& now) const {
  const double whole = length(ends[1] - ends[0]);
  const Vec2 ahead = (ends[1] - ends[0]) / whole;
  const std::string text = lengthLabel(whole, overlays_.units.pixels) + " " + ruler.unit;
  Vec2 beside(-ahead.y(), ahead.x());
  const bool steep = std::abs(beside.x()) > 0.5; // by more than 30°
  if (steep ? beside.x() < 0.0 : beside.y() > 0.0) beside = -beside;
  TextLook look;
  look.size = ruler.labelSize;
  look.color = ruler.color;
  look.anchor = NinePosition::Center;
  const Viewport& camera = now.painter.viewport();
  const Viewport& frame = now.texts.viewport();
  const double ticks = kLongTick * std::max(ruler.width / kUsualRuler, 1.0) * (camera.scale / frame.scale);
  const Vec2 box = now.texts.measure(text, look);
  const double reach = 0.5 * beside.cwiseAbs().dot(box); // of the box towards it
  const Vec2 middle = shownAt(0.5 * (ends[0] + ends[1]), frame, camera);
  const Vec2 away = beside * (ticks + 0.3 * ruler.labelSize + reach);
  const Vec2 low = toPane(frame, Vec2(frame.clip.left, frame.clip.top)) + 0.5 * box;
  const Vec2 high = toPane(frame, Vec2(frame.clip.right, frame.clip.bottom)) - 0.5 * box;
  const auto fits = [&](const Vec2& at) {
    return (at.array() >= low.array()).all() && (at.array() <= high.array()).all();
  };
  const bool otherSide = !fits(middle + away) && fits(middle - away);
  const Vec2 at = middle + away * (otherSide ? -1.0 : 1.0);
  now.texts.draw(picture, text, look, at, 1.0, true);
}

} // namespace offstage
