#include "render/job/scene_source.h"

namespace offstage {

SceneSource::SceneSource(const Scene& scene, Viewport viewport)
    : clock_(scene.clock), title_(scene.title), world_(scene.world), painter_(viewport, scene.background) {
  // The painter numbers looks as the scene does, so Body::look needs no translation.
  for (const Look& look : scene.looks) painter_.addLook(look);
}

void SceneSource::draw(Picture& picture) const {
  painter_.begin(picture);
  for (const Body& body : world_.bodies()) painter_.body(picture, body, body.look);
}

} // namespace offstage
