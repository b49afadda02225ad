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
         x.innerHigh == y.innerHigh && samePattern(a, x, b, y) && sameMask(a, x, b, y);
}

Layer makeLayer(const DisplayList& list, const Primitive& primitive, int largestPoint,
                PatternTexture& patterns) {
  Layer layer;
  if (list.clip.empty()) return layer;
  const std::optional<Drawable> drawable = makeDrawable(primitive, list.clip, largestPoint);
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

} // namespace

void updateDisplayList(const Picture& picture, int largestPoint, const DisplayList& before,
                       PatternTexture& patterns, DisplayList& now, std::vector<LayerChange>& changes) {
  now.background = picture.background;
  now.clip = {std::max(picture.clip.left, 0), std::max(picture.clip.top, 0),
              std::min(picture.clip.right, picture.width), std::min(picture.clip.bottom, picture.height)};
  now.primitives = picture.primitives;
  now.patterns = picture.patterns;
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
  const std::size_t pairs = std::min(oldMiddle, middle);

  now.layers.resize(present);
  for (std::size_t i = 0; i < middle; ++i) {
    if (i < pairs && samePrimitive(before, i, now, i)) {
      now.layers[i] = before.layers[i];
      continue;
    }
    now.layers[i] = makeLayer(now, now.primitives[i], largestPoint, patterns);
    const auto index = static_cast<std::int32_t>(i);
    changes.push_back({i < pairs ? index : -1, index, index});
  }
  for (std::size_t i = pairs; i < oldMiddle; ++i) {
    changes.push_back({static_cast<std::int32_t>(i), -1, static_cast<std::int32_t>(middle)});
  }
  std::copy_n(before.layers.begin() + static_cast<std::ptrdiff_t>(oldMiddle), suffix,
              now.layers.begin() + static_cast<std::ptrdiff_t>(middle));
}

} // namespace offstage
