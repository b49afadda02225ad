#include "render/job/panel_set.h"

#include "render/draw/fit_text.h"
#include "render/draw/pen.h"
#include "render/job/fingerprint.h"
#include "render/job/scene_source.h"
#include "render/raster/tile_set.h"
#include "src/scene/palette.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace offstage {
namespace {

constexpr double kDotRadius = 0.3; ///< em of a panel's title; it takes up three
constexpr double kRounding = 1e-9; ///< s: a frame that is due up to rounding is due

/// The part of the output in which pane number `index` is drawn. It starts on a whole pixel, so that what is
/// sharp in it stays sharp.
Viewport viewportOf(const Scene& scene, const Viewport& whole, std::size_t index) {
  const auto place = scene.panels.place(index, scene.size[0], scene.size[1]);
  Viewport viewport = whole;
  viewport.scale = whole.scale * place[2] / scene.panels.pane[0];
  for (int axis = 0; axis < 2; ++axis)
    viewport.offset[axis] =
        std::round(place.at(static_cast<std::size_t>(axis)) * whole.scale + whole.offset[axis]);
  const auto edge = [&](int axis) {
    const double length = scene.panels.pane.at(static_cast<std::size_t>(axis)) * viewport.scale;
    return static_cast<int>(viewport.offset[axis] + std::round(length));
  };
  viewport.clip = common(whole.clip, {static_cast<int>(viewport.offset.x()),
                                      static_cast<int>(viewport.offset.y()), edge(0), edge(1)});
  return viewport;
}

} // namespace

PanelSet::PanelSet(const Scene& scene, const Viewport& whole) : viewport_(whole), texts_(whole) {
  for (std::size_t i = 0; i < scene.panels.panels.size(); ++i)
    worlds_.push_back(
        std::make_unique<SceneSource>(*scene.panels.panels[i].scene, viewportOf(scene, whole, i)));
  makeCaptions(scene);
  if (scene.panels.layout == Panels::Layout::Overlaid) return;
  frameWidth_ = std::max(std::round(whole.scale), 1.0);
  // Outside of the pane, unless neighbours are so near that their lines would lie over each other.
  if (scene.panels.gap * whole.scale < 2.0 * frameWidth_) frameInset_ = frameWidth_;
  const Color ink = inkOn(scene.background, 0.35);
  frameColor_ = {ink.red, ink.green, ink.blue, ink.alphaByte()};
}

PanelSet::~PanelSet() = default;

/// A line around the pane.
void PanelSet::frame(Picture& picture, const PixelRect& pane) const {
  if (!(frameWidth_ > 0.0)) return;
  Primitive line;
  line.kind = Primitive::Kind::BoxRing;
  line.color = frameColor_;
  line.innerLow = Vec2(pane.left, pane.top) + Vec2::Constant(frameInset_);
  line.innerHigh = Vec2(pane.right, pane.bottom) - Vec2::Constant(frameInset_);
  line.low = line.innerLow - Vec2::Constant(frameWidth_);
  line.high = line.innerHigh + Vec2::Constant(frameWidth_);
  picture.primitives.push_back(line);
}

/// Above each pane and no wider than it; of overlaid panels a legend, line below line.
void PanelSet::makeCaptions(const Scene& scene) {
  const Panels& panels = scene.panels;
  const bool overlaid = panels.layout == Panels::Layout::Overlaid;
  const double line = overlaid ? panels.pane[1] / 12.0 : panels.caption;
  if (!(line > 0.0)) return;
  for (std::size_t i = 0; i < panels.panels.size(); ++i) {
    const Panel& panel = panels.panels[i];
    if (panel.title.empty()) continue;
    Caption caption{
        panel.title, {}, Vec2(line, line * (0.8 + static_cast<double>(captions_.size()))), panel.color};
    caption.look.size = 0.6 * line;
    caption.look.color = inkOn(scene.background);
    caption.look.anchor = overlaid ? NinePosition::Left : NinePosition::Center;
    const auto place = panels.place(i, scene.size[0], scene.size[1]);
    if (overlaid) {
      caption.at += Vec2(place[0], place[1]);
    } else {
      caption.at = Vec2(place[0] + 0.5 * place[2], place[1] - 0.5 * line);
    }
    FittedText fitted = fitText(texts_, caption.text, caption.look, overlaid ? place[2] - line : place[2],
                                kLeastShare * caption.look.size, caption.dot ? 3.0 * kDotRadius : 0.0);
    caption.text = std::move(fitted.text);
    caption.look = fitted.look;
    captions_.push_back(std::move(caption));
  }
}

/// A panel's colour stands before its title as a disc; both together are in the middle.
void PanelSet::drawCaptions(Picture& picture) const {
  for (const Caption& caption : captions_) {
    Vec2 at = caption.at;
    if (caption.dot) {
      const double radius = kDotRadius * caption.look.size;
      const bool centered = caption.look.anchor == NinePosition::Center;
      const double width = texts_.measure(caption.text, caption.look).x();
      const double left = centered ? at.x() - 0.5 * (width + 3.0 * radius) : at.x();
      const Vec2 dot = Vec2(left + radius, at.y()) * viewport_.scale + viewport_.offset;
      const Color& color = *caption.dot;
      Pen(picture, 1.0, {color.red, color.green, color.blue, color.alphaByte()})
          .disc(dot, radius * viewport_.scale);
      at.x() += centered ? 1.5 * radius : 3.0 * radius;
    }
    texts_.draw(picture, caption.text, caption.look, at);
  }
}

void PanelSet::watch(const Scene& scene, WarningLog& log) {
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    const Panel& panel = scene.panels.panels[i];
    const std::string number = "number " + std::to_string(i + 1);
    worlds_[i]->watch(*panel.scene, log, panel.title.empty() ? number : panel.title);
  }
}

void PanelSet::stepTo(double time) {
  for (const auto& world : worlds_) {
    const Clock& clock = world->clock();
    while (world->frame() < clock.steps() && clock.time(world->frame() + 1) <= time + kRounding)
      world->step();
  }
}

void PanelSet::keepMoment() {
  for (const auto& world : worlds_) world->keepMoment();
}

void PanelSet::draw(Picture& picture) const {
  for (const auto& world : worlds_) {
    const std::size_t first = picture.primitives.size();
    world->paint(picture);
    const auto pane = static_cast<std::int32_t>(picture.clips.size());
    picture.clips.push_back(world->painter().viewport().clip);
    // What has a clip of its own lies inside its pane.
    for (std::size_t i = first; i < picture.primitives.size(); ++i)
      if (picture.primitives[i].clip < 0) picture.primitives[i].clip = pane;
    frame(picture, picture.clips[static_cast<std::size_t>(pane)]);
  }
  drawCaptions(picture);
}

std::vector<std::int64_t> PanelSet::frames() const {
  std::vector<std::int64_t> frames;
  for (const auto& world : worlds_) frames.push_back(world->frame());
  return frames;
}

std::uint64_t PanelSet::stateHash() const {
  Fingerprint hash;
  for (const auto& world : worlds_) hash.add(static_cast<std::int64_t>(world->stateHash()));
  return hash.value();
}

std::uint64_t PanelSet::fingerprint() const {
  Fingerprint hash;
  for (const auto& world : worlds_) hash.add(static_cast<std::int64_t>(world->fingerprint()));
  return hash.value();
}

} // namespace offstage
