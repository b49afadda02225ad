#pragma once

#include "render/draw/overlay_history.h"
#include "render/draw/overlay_painter.h"
#include "render/draw/painter.h"
#include "render/draw/plot_set.h"
#include "render/draw/scene_texts.h"
#include "render/job/panel_set.h"
#include "render/job/source.h"
#include "src/scene/scene.h"
#include "src/sim/probe.h"
#include "src/sim/world.h"

#include <memory>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

namespace offstage {

/// A scene file's world, or the trace that it replays, as something to render.
class SceneSource : public Source {
public:
  /// Decodes the scene's images. Throws SceneError or Error for what parsing could not know.
  SceneSource(const Scene& scene, Viewport viewport);

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
  /// From now on the bodies of the kept moments are drawn, instead of those of the present frame; one that
  /// has not moved since it was kept last is drawn once. What `still --strobe` shows.
  void keepMoment();
  /// Adds the present frame to a picture, without beginning a new one.
  void paint(Picture& picture) const;

private:
  void note(); ///< the present frame, to what remembers the past

  Clock clock_;
  std::string title_;
  std::variant<World, ReplayMotion> motion_; ///< simulated or replayed
  Painter painter_;
  OverlayHistory history_;
  OverlayPainter overlays_;
  TextPainter textPainter_;
  PlotSet plots_;
  std::unique_ptr<PanelSet> panels_; ///< null: one world, `motion_`; else motion_ is not drawn
  std::vector<Body> kept_;
  std::unordered_map<std::uint32_t, Vec2> keptAt_; ///< position by body
  SceneTexts texts_;
  std::uint64_t fingerprint_; ///< of the scene's text, its clock, its images and its fonts
};

} // namespace offstage
