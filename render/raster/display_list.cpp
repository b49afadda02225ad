#include "render/raster/display_list.h"

#include <algorithm>
#include <optional>

namespace offstage {
namespace {

bool samePattern(const DisplayList& a, const Primitive& ofA, const DisplayList& b, const Primitive& ofB) {
  if (ofA.pattern < 0 || ofB.pattern < 0) return ofA.pattern < 0 && ofB.pattern < 0;
  return a.patterns.at(static_cast<std::size_t>(ofA.pattern)) ==
         b.patterns.at(static_cast<std::size_t>(ofB.pattern));
}

bool sameMask(const DisplayList& a, const Primitive& ofA, const DisplayList& b, const Primitive& ofB) {
  if (ofA.kind != Primitive::Kind::Mask) return true;
  return a.masks.at(static_cast<std::size_t>(ofA.mask)) == b.masks.at(static_cast<std::size_t>(ofB.mask));
}

bool samePrimitive(const DisplayList& a, std::size_t i, const DisplayList& b, std::size_t j) {
  const Primitive& x = a.primitives[i];
  const Primitive& y = b.primitives[j];
  return x.kind == y.kind && x.color == y.color && x.center == y.center && x.outer == y.outer &&
         x.inner == y.inner && x.low == y.low && x.high == y.high && x.innerLow == y.innerLow &&
         x.innerHigh == y.innerHigh && a.clipOf(x) == b.clipOf(y) && samePattern(a, x, b, y) &&
         sameMask(a, x, b, y);
}

Layer makeLayer(const DisplayList& list, const Primitive& primitive, int largestPoint,
                PatternTexture& patterns) {
  Layer layer;
  layer.clip = list.clipOf(primitive);
  if (layer.clip.empty()) return layer;
  const std::optional<Drawable> drawable = makeDrawable(primitive, layer.clip, largestPoint);
  if (!drawable) return layer;
  layer.visible = true;
  layer.instance = drawable->instance;
  layer.program = {drawable->coverage, PaintSource::Color, drawable->footprint};
  if (primitive.kind == Primitive::Kind::Mask) {
    patterns.place(list.masks.at(static_cast<std::size_t>(primitive.mask)), layer.instance);
  } else if (primitive.pattern >= 0) {
    const PlacedPattern& pattern = list.patterns.at(static_cast<std::size_t>(primitive.pattern));
    layer.program.paint =
        patterns.place(pattern, layer.instance) ? PaintSource::Reduced : PaintSource::Pattern;
  }
  return layer;
}

/// How many layers have gone or come here, so that the lists are the same again behind them.
struct Shift {
  std::size_t gone = 0;
  std::size_t come = 0;
};

/// Looks a little ahead where two layers are of different sorts: a trail or a curve that has become longer by
/// a piece must not make everything above it look new.
Shift findShift(const DisplayList& before, std::size_t i, std::size_t oldEnd, const DisplayList& now,
                std::size_t j, std::size_t end) {
  constexpr std::size_t kAhead = 8;
  const Primitive& x = before.primitives[i];
  const Primitive& y = now.primitives[j];
  // A body that has moved. Of lines any may be another one: a trail loses its oldest piece and gets a new
  // one.
  if (x.kind == y.kind && x.color == y.color && x.kind < Primitive::Kind::Quad) return {};
  for (std::size_t d = 1; d <= kAhead; ++d) {
    if (j + d < end && samePrimitive(before, i, now, j + d)) return {0, d};
    if (i + d < oldEnd && samePrimitive(before, i + d, now, j)) return {d, 0};
  }
  return {};
}

} // namespace

void updateDisplayList(const Picture& picture, int largestPoint, const DisplayList& before,
                       PatternTexture& patterns, DisplayList& now, std::vector<LayerChange>& changes) {
  now.background = picture.background;
  now.clip = {std::max(picture.clip.left, 0), std::max(picture.clip.top, 0),
              std::min(picture.clip.right, picture.width), std::min(picture.clip.bottom, picture.height)};
  now.primitives = picture.primitives;
  now.patterns = picture.patterns;
  now.clips = picture.clips;
  now.masks = picture.masks;
  changes.clear();

  const std::size_t old = before.clip == now.clip ? before.primitives.size() : 0;
  const std::size_t present = now.primitives.size();
  std::size_t suffix = 0; // layers at the end that are the same, for when some below them came or went
  if (old != present) {
    while (suffix < std::min(old, present) &&
           samePrimitive(before, old - 1 - suffix, now, present - 1 - suffix))
      ++suffix;
  }
  const std::size_t oldMiddle = old - suffix;
  const std::size_t middle = present - suffix;

  now.layers.resize(present);
  const auto make = [&](std::int32_t replaced, std::size_t j) {
    now.layers[j] = makeLayer(now, now.primitives[j], largestPoint, patterns);
    const auto index = static_cast<std::int32_t>(j);
    changes.push_back({replaced, index, index});
  };
  std::size_t i = 0; // in the list before
  std::size_t j = 0; // in this one
  while (i < oldMiddle && j < middle) {
    if (samePrimitive(before, i, now, j)) {
      now.layers[j++] = before.layers[i++];
      continue;
    }
    const Shift shift = findShift(before, i, oldMiddle, now, j, middle);
    for (std::size_t k = 0; k < shift.gone; ++k, ++i)
      changes.push_back({static_cast<std::int32_t>(i), -1, static_cast<std::int32_t>(j)});
    for (std::size_t k = 0; k < shift.come; ++k) make(-1, j++);
    if (shift.gone == 0 && shift.come == 0) make(static_cast<std::int32_t>(i++), j++);
  }
  for (; j < middle; ++j) make(-1, j);
  for (; i < oldMiddle; ++i)
    changes.push_back({static_cast<std::int32_t>(i), -1, static_cast<std::int32_t>(middle)});
  std::copy_n(before.layers.begin() + static_cast<std::ptrdiff_t>(oldMiddle), suffix,
              now.layers.begin() + static_cast<std::ptrdiff_t>(middle));
}

} // namespace offstage
