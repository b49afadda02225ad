#pragma once

#include "render/draw/painter.h"
#include "render/job/source.h"
#include "src/scene/scene.h"
#include "src/sim/world.h"

namespace offstage {

/// A scene file's world as something to render.
class SceneSource : public Source {
public:
  /// Decodes the scene's images. Throws SceneError or Error for what parsing could not know.
  SceneSource(const Scene& scene, Viewport viewport);

  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] const std::string& title() const override { return title_; }
  [[nodiscard]] std::int64_t frame() const override { return world_.frame(); }
  void step() override { world_.step(clock_.tick(world_.frame() + 1)); }
  void draw(Picture& picture) const override;
  [[nodiscard]] std::uint64_t stateHash() const override { return world_.stateHash(); }
  [[nodiscard]] std::uint64_t fingerprint() const override { return fingerprint_; }

  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const Painter& painter() const { return painter_; }

private:
  Clock clock_;
  std::string title_;
  World world_;
  Painter painter_;
  std::uint64_t fingerprint_; ///< of the scene's text, its clock and its images
};

} // namespace offstage
