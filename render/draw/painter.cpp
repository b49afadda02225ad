#include "render/draw/painter.h"

#include "render/draw/pen.h"
#include "src/scene/palette.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace offstage {
namespace {

Rgba8 bytes(const Color& color, double opacity) {
  return {color.red, color.green, color.blue, color.alphaByte(opacity)};
}

bool finite(const Vec2& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y());
}

/// Whether something between low and high can be seen. Written so that NaN is not.
bool visible(const Viewport& viewport, const Vec2& low, const Vec2& high) {
  const PixelRect& clip = viewport.clip;
  return low.x() < clip.right && low.y() < clip.bottom && high.x() > clip.left && high.y() > clip.top;
}

} // namespace

Painter::Painter(Viewport viewport, Color background)
    : viewport_(std::move(viewport)), background_(bytes(background, 1.0)) {}

std::uint32_t Painter::addLook(const Look& look) {
  looks_.push_back(prepare(look));
  return static_cast<std::uint32_t>(looks_.size() - 1);
}

void Painter::setLook(std::uint32_t index, const Look& look) {
  looks_.at(index) = prepare(look);
}

Painter::PreparedLook Painter::prepare(const Look& look) {
  PreparedLook prepared;
  if (look.fill) prepared.fill = prepare(*look.fill, look.opacity);
  if (look.stroke && look.stroke->width > 0.0) {
    prepared.stroke = prepare(look.stroke->paint, look.opacity);
    prepared.strokeWidth = look.stroke->width;
    prepared.strokeAlign = look.stroke->align;
  }
  return prepared;
}

Painter::PreparedPaint Painter::prepare(const Paint& paint, double opacity) {
  PreparedPaint prepared;
  if (const auto* color = std::get_if<Color>(&paint)) {
    prepared.color = bytes(*color, opacity);
    return prepared;
  }
  const auto& pattern = std::get<ImagePattern>(paint);
  prepared.color = bytes(Color{}, opacity);
  prepared.image = images_.get(pattern);
  prepared.anchor = pattern.anchor;
  prepared.proportional = pattern.proportional;
  return prepared;
}

void Painter::begin(Picture& picture) const {
  picture.clear();
  picture.width = viewport_.width;
  picture.height = viewport_.height;
  picture.background = background_;
  picture.clip = viewport_.clip;
}

void Painter::circle(Picture& picture, const Vec2& center, double radius, std::uint32_t look,
                     double opacity) const {
  if (!finite(center) || !std::isfinite(radius) || !(radius > 0.0)) return;
  const PreparedLook& prepared = looks_.at(look);
  Primitive primitive;
  primitive.center = center * viewport_.scale + viewport_.offset;
  const double outline = radius * viewport_.scale;
  const Vec2 reach(outline, outline);
  const Bounds bounds{primitive.center - reach, primitive.center + reach};
  if (prepared.fill) {
    primitive.kind = Primitive::Kind::Disc;
    primitive.outer = outline;
    add(picture, primitive, bounds, {*prepared.fill, opacity, false});
  }
  if (!prepared.stroke) return;
  // JavaFX strokes the outline with a centred pen, for INSIDE and OUTSIDE of twice the width and then cut by
  // the outline. A pen wider than the circle turns its inner edge inside out, hence the absolute value:
  // the middle stays free (oracle/stills/06, last row).
  const bool centered = prepared.strokeAlign == StrokeAlign::Centered;
  const double half = viewport_.scale * (centered ? 0.5 * prepared.strokeWidth : prepared.strokeWidth);
  primitive.kind = Primitive::Kind::Ring;
  primitive.inner = std::abs(outline - half);
  primitive.outer = outline + half;
  if (prepared.strokeAlign == StrokeAlign::Inside) primitive.outer = outline;
  if (prepared.strokeAlign == StrokeAlign::Outside) primitive.inner = std::max(primitive.inner, outline);
  if (primitive.inner < primitive.outer) add(picture, primitive, bounds, {*prepared.stroke, opacity, true});
}

void Painter::rectangle(Picture& picture, const Vec2& position, const Vec2& size, std::uint32_t look,
                        double opacity) const {
  if (!finite(position) || !finite(size) || !(size.x() > 0.0) || !(size.y() > 0.0)) return;
  const PreparedLook& prepared = looks_.at(look);
  const Vec2 low = position * viewport_.scale + viewport_.offset;
  const Bounds bounds{low, low + size * viewport_.scale};
  Primitive primitive;
  if (prepared.fill) {
    primitive.kind = Primitive::Kind::Box;
    primitive.low = bounds.low;
    primitive.high = bounds.high;
    add(picture, primitive, bounds, {*prepared.fill, opacity, false});
  }
  if (!prepared.stroke) return;
  const double width = prepared.strokeWidth * viewport_.scale;
  const double outward = prepared.strokeAlign == StrokeAlign::Centered  ? 0.5 * width
                         : prepared.strokeAlign == StrokeAlign::Outside ? width
                                                                        : 0.0;
  const Vec2 outside(outward, outward);
  const Vec2 inside(width - outward, width - outward);
  primitive.kind = Primitive::Kind::BoxRing;
  primitive.low = bounds.low - outside;
  primitive.high = bounds.high + outside;
  primitive.innerLow = bounds.low + inside;
  primitive.innerHigh = bounds.high - inside;
  add(picture, primitive, bounds, {*prepared.stroke, opacity, true});
}

void Painter::body(Picture& picture, const Body& body, std::uint32_t look, double opacity) const {
  if (body.shape == Shape::Circle) {
    circle(picture, body.position, body.radius, look, opacity);
  } else {
    rectangle(picture, body.position, body.size, look, opacity);
  }
}

Rgba8 Painter::colorOf(std::uint32_t look) const {
  const PreparedLook& prepared = looks_.at(look);
  for (const std::optional<PreparedPaint>& paint : {prepared.fill, prepared.stroke}) {
    if (!paint || paint->image != nullptr || paint->color.a == 0) continue;
    return {paint->color.r, paint->color.g, paint->color.b, 255};
  }
  return bytes(inkOn({background_.r, background_.g, background_.b, background_.a / 255.0}), 1.0);
}

void Painter::veil(Picture& picture, Rgba8 color) const {
  if (color.a > 0) picture.primitives.push_back(layer(color));
}

void Painter::ground(Picture& picture, Rgba8 color) const {
  if (color.a > 0) picture.primitives.insert(picture.primitives.begin(), layer(color));
}

Primitive Painter::layer(Rgba8 color) const {
  Primitive primitive;
  primitive.kind = Primitive::Kind::Box;
  primitive.color = color;
  primitive.low = Vec2(viewport_.clip.left, viewport_.clip.top);
  primitive.high = Vec2(viewport_.clip.right, viewport_.clip.bottom);
  return primitive;
}

/// Appends the primitive with its paint, unless nothing of it can be seen.
void Painter::add(Picture& picture, Primitive& primitive, const Bounds& bounds, const Coat& coat) const {
  const PreparedPaint& paint = coat.paint;
  primitive.color = faded(paint.color, coat.opacity);
  if (primitive.color.a == 0) return;
  const bool round = primitive.kind == Primitive::Kind::Disc || primitive.kind == Primitive::Kind::Ring;
  const Vec2 reach(primitive.outer, primitive.outer);
  if (!(round ? visible(viewport_, primitive.center - reach, primitive.center + reach)
              : visible(viewport_, primitive.low, primitive.high))) {
    return;
  }
  primitive.pattern = -1;
  if (paint.image != nullptr) {
    const Vec2 anchorLow(paint.anchor[0], paint.anchor[1]);
    const Vec2 anchorSize(paint.anchor[2], paint.anchor[3]);
    PlacedPattern placed;
    placed.image = paint.image;
    if (paint.proportional) {
      const Vec2 extent = bounds.high - bounds.low;
      placed.origin = bounds.low + anchorLow.cwiseProduct(extent);
      placed.size = anchorSize.cwiseProduct(extent);
      const Vec2 anchorHigh = anchorLow + anchorSize;
      const bool covers =
          anchorLow.x() <= 0.0 && anchorLow.y() <= 0.0 && anchorHigh.x() >= 1.0 && anchorHigh.y() >= 1.0;
      placed.repeat =
          coat.isStroke || !covers; // a stroke reaches beyond the box that the pattern is fitted to
    } else {
      placed.origin = anchorLow * viewport_.scale + viewport_.offset;
      placed.size = anchorSize * viewport_.scale;
      placed.repeat = true;
    }
    if (!finite(placed.origin) || !(placed.size.x() > 0.0) || !(placed.size.y() > 0.0) ||
        !finite(placed.size)) {
      return;
    }
    primitive.pattern = static_cast<std::int32_t>(picture.patterns.size());
    picture.patterns.push_back(std::move(placed));
  }
  picture.primitives.push_back(primitive);
}

} // namespace offstage
