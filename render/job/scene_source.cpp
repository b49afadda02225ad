#include "render/job/scene_source.h"

#include "render/job/fingerprint.h"

namespace offstage {
namespace {

std::variant<World, ReplayMotion> motionOf(const Scene& scene) {
  if (scene.replay) return ReplayMotion(scene.replay);
  return World(scene.world);
}

void addPaint(Fingerprint& fingerprint, const Paint& paint) {
  if (const auto* pattern = std::get_if<ImagePattern>(&paint)) fingerprint.addFile(pattern->file);
}

std::uint64_t fingerprintOf(const Scene& scene) {
  Fingerprint fingerprint;
  fingerprint.add(scene.text);
  fingerprint.add(scene.clock);
  for (const Look& look : scene.looks) {
    if (look.fill) addPaint(fingerprint, *look.fill);
    if (look.stroke) addPaint(fingerprint, look.stroke->paint);
  }
  for (const TextItem& item : scene.texts) fingerprint.addFile(fontFile(item.look.font));
  if (scene.replay) fingerprint.addFile(scene.replay->trace.file);
  return fingerprint.value();
}

} // namespace

SceneSource::SceneSource(const Scene& scene, Viewport viewport)
    : clock_(scene.clock),
      title_(scene.title),
      motion_(motionOf(scene)),
      painter_(viewport, scene.background),
      history_(scene.overlays),
      overlays_(scene.overlays, scene.world),
      textPainter_(viewport),
      plots_(scene, viewport, textPainter_),
      texts_(scene, viewport),
      fingerprint_(fingerprintOf(scene)) {
  // The painter numbers looks as the scene does, so Body::look needs no translation.
  for (const Look& look : scene.looks) painter_.addLook(look);
  if (!scene.panels.panels.empty()) {
    panels_ = std::make_unique<PanelSet>(scene, painter_.viewport());
    Fingerprint both;
    both.add(static_cast<std::int64_t>(fingerprint_));
    both.add(static_cast<std::int64_t>(panels_->fingerprint()));
    fingerprint_ = both.value();
  }
  note();
}

std::int64_t SceneSource::frame() const {
  return std::visit([](const auto& motion) { return motion.frame(); }, motion_);
}

void SceneSource::step() {
  std::visit([tick = clock_.tick(frame() + 1)](auto& motion) { motion.step(tick); }, motion_);
  if (panels_ != nullptr) panels_->stepTo(time());
  note();
}

void SceneSource::note() {
  const auto* world = std::get_if<World>(&motion_);
  history_.note(time(), bodies(), world != nullptr ? world->events() : std::span<const Event>());
}

void SceneSource::draw(Picture& picture) const {
  painter_.begin(picture);
  paint(picture);
}

void SceneSource::paint(Picture& picture) const {
  if (panels_ != nullptr) {
    panels_->draw(picture);
    return;
  }
  const OverlayPainter::Now now{time(), bodies(), history_, painter_, textPainter_};
  overlays_.paint(picture, OverlayLayer::Behind, now);
  for (const Body& body : kept_.empty() ? bodies() : std::span<const Body>(kept_))
    painter_.body(picture, body, body.look);
  overlays_.paint(picture, OverlayLayer::Front, now);
  plots_.draw(picture, frame());
  texts_.draw(picture, snapshot());
}

void SceneSource::keepMoment() {
  if (panels_ != nullptr) panels_->keepMoment();
  for (const Body& body : bodies()) {
    const auto [place, isNew] = keptAt_.try_emplace(body.id, body.position);
    if (!isNew && place->second == body.position) continue;
    place->second = body.position;
    kept_.push_back(body);
  }
}

std::uint64_t SceneSource::stateHash() const {
  if (panels_ != nullptr) return panels_->stateHash();
  return std::visit([](const auto& motion) { return motion.stateHash(); }, motion_);
}

double SceneSource::time() const {
  return std::visit([](const auto& motion) { return motion.time(); }, motion_);
}

Snapshot SceneSource::snapshot() const {
  if (const auto* world = std::get_if<World>(&motion_)) return snapshotOf(*world);
  Snapshot snapshot; // a trace has no gravity and no forces
  snapshot.frame = frame();
  snapshot.time = time();
  snapshot.bodies = bodies();
  return snapshot;
}

std::span<const Body> SceneSource::bodies() const {
  return std::visit([](const auto& motion) { return motion.bodies(); }, motion_);
}

} // namespace offstage
