#include "render/job/scene_source.h"

#include "render/job/fingerprint.h"

namespace offstage {
namespace {

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
  return fingerprint.value();
}

} // namespace

SceneSource::SceneSource(const Scene& scene, Viewport viewport)
    : clock_(scene.clock),
      title_(scene.title),
      world_(scene.world),
      painter_(viewport, scene.background),
      fingerprint_(fingerprintOf(scene)) {
  // The painter numbers looks as the scene does, so Body::look needs no translation.
  for (const Look& look : scene.looks) painter_.addLook(look);
}

void SceneSource::draw(Picture& picture) const {
  painter_.begin(picture);
  for (const Body& body : world_.bodies()) painter_.body(picture, body, body.look);
}

} // namespace offstage
