#pragma once

#include "render/draw/painter.h"
#include "render/draw/scene_texts.h"
#include "render/job/source.h"
#include "src/scene/scene.h"
#include "src/sim/probe.h"
#include "src/sim/world.h"

#include <span>
#include <variant>

namespace offstage {

/// A scene file's world, or the trace that it replays, as something to render.
class SceneSource : public Source {
public:
  /// Decodes the scene's images. Throws SceneError or Error for what parsing could not know.
  SceneSource(const Scene& scene, const Viewport& viewport);

  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] const std::string& title() const override { return title_; }
  [[nodiscard]] std::int64_t frame() const override;
  void step() override;
  void draw(Picture& picture) const override;
  [[nodiscard]] std::uint64_t stateHash() const override;
  [[nodiscard]] std::uint64_t fingerprint() const override { return fingerprint_; }

  [[nodiscard]] double time() const; ///< s: of the present frame
  /// What probes see of the present frame. Valid until the next step.
  [[nodiscard]] Snapshot snapshot() const;
  /// The bodies of the present frame in the order in which they are drawn. Valid until the next step.
  [[nodiscard]] std::span<const Body> bodies() const;
  [[nodiscard]] const Painter& painter() const { return painter_; }
  void drawTexts(Picture& picture) const { texts_.draw(picture, snapshot()); } ///< of the present frame

private:
  Clock clock_;
  std::string title_;
  std::variant<World, ReplayMotion> motion_; ///< simulated or replayed
  Painter painter_;
  SceneTexts texts_;
  std::uint64_t fingerprint_; ///< of the scene's text, its clock, its images and its fonts
};

} // namespace offstage
