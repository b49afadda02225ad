#include "render/job/scene_source.h"

namespace offstage {
namespace {

std::variant<World, ReplayMotion> motionOf(const Scene& scene) {
  if (scene.replay) return ReplayMotion(scene.replay);
  return World(scene.world);
}

} // namespace

SceneSource::SceneSource(const Scene& scene, Viewport viewport)
    : clock_(scene.clock),
      title_(scene.title),
      motion_(motionOf(scene)),
      painter_(viewport, scene.background) {
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
}

std::uint64_t SceneSource::stateHash() const {
  return std::visit([](const auto& motion) { return motion.stateHash(); }, motion_);
}

double SceneSource::time() const {
  return std::visit([](const auto& motion) { return motion.time(); }, motion_);
}

std::span<const Body> SceneSource::bodies() const {
  return std::visit([](const auto& motion) { return motion.bodies(); }, motion_);
}

} // namespace offstage
