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

SceneSource::SceneSource(const Scene& scene, const Viewport& viewport)
    : clock_(scene.clock),
      title_(scene.title),
      motion_(motionOf(scene)),
      painter_(viewport, scene.background),
      texts_(scene, viewport),
      fingerprint_(fingerprintOf(scene)) {
  // The painter numbers looks as the scene does, so Body::look needs no translation.
  for (const Look& look : scene.looks) painter_.addLook(look);
}

std::int64_t SceneSource::frame() const {
  return std::visit([](const auto& motion) { return motion.frame(); }, motion_);
}

void SceneSource::step() {
  std::visit([tick = clock_.tick(frame() + 1)](auto& motion) { motion.step(tick); }, motion_);
}

void SceneSource::draw(Picture& picture) const {
  painter_.begin(picture);
  for (const Body& body : bodies()) painter_.body(picture, body, body.look);
  drawTexts(picture);
}

std::uint64_t SceneSource::stateHash() const {
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
