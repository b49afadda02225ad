#include "render/stage/frame_at.h"

#include "render/job/scene_source.h"
#include "render/job/still.h"
#include "render/stage/stage_source.h"
#include "src/scene/scene.h"

namespace offstage {

Frame sceneFrame(const std::filesystem::path& scene, double at) {
  const Scene loaded = loadScene(scene);
  SceneSource source(loaded, Viewport::scaled(loaded.size[0], loaded.size[1], loaded.scale));
  return drawFrame(source, at);
}

Frame exerciseFrame(std::unique_ptr<Exercise> exercise, double at) {
  StageSource source(std::move(exercise), {});
  return drawFrame(source, at);
}

} // namespace offstage
