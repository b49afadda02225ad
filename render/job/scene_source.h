#pragma once

#include "render/draw/camera.h"
#include "render/draw/overlay_history.h"
#include "render/draw/overlay_painter.h"
#include "render/draw/painter.h"
#include "render/draw/plot_set.h"
#include "render/draw/scene_texts.h"
#include "render/draw/title_card.h"
#include "render/job/panel_set.h"
#include "render/job/source.h"
#include "render/job/warning_log.h"
#include "src/scene/scene.h"
#include "src/sim/probe.h"
#include "src/sim/world.h"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

namespace offstage {

/// A scene file's world, or the trace that it replays, as something to render.
class SceneSource : public Source {
public:
  /// Decodes the scene's images and measures its sound files. Throws SceneError or Error for what parsing
  /// could not know.
  SceneSource(const Scene& scene, const Viewport& viewport);

  /// From here on, frame 0, what is wrong with the run of what is drawn goes to `log`, which outlives this.
  /// `scene` is that of the constructor; `panel` the title of the panel that it is.
  void watch(const Scene& scene, WarningLog& log, const std::string& panel = {});

  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] const std::string& title() const override { return title_; }
  [[nodiscard]] std::int64_t frame() const override;
  void step() override;
  void draw(Picture& picture) const override;
  [[nodiscard]] std::uint64_t stateHash() const override;
  [[nodiscard]] std::uint64_t fingerprint() const override { return fingerprint_; }

  [[nodiscard]] const Film* film() const override { return &film_; }
  /// A moment between two frames shows the bodies that live in the earlier one: those that live in both are
  /// placed on the straight line between their two positions.
  void show(const Shot& shot) override;
  [[nodiscard]] std::uint64_t shownStateHash() const override;
  [[nodiscard]] bool followsVideoTime() const override;
  [[nodiscard]] bool hasCaptions() const override;
  [[nodiscard]] VideoTracks tracks(double from, double to) const override;

  [[nodiscard]] double time() const; ///< s of simulated time: of the present frame
  /// What probes see of what is shown. Valid until the next step.
  [[nodiscard]] Snapshot snapshot() const;
  /// The bodies of the present frame in the order in which they are drawn. Valid until the next step.
  [[nodiscard]] std::span<const Body> bodies() const;
  /// Those that draw() draws, in the same order. Valid until the next step.
  [[nodiscard]] std::span<const Body> shownBodies() const;
  [[nodiscard]] const Painter& painter() const { return painter_; }
  /// From now on the bodies of the kept moments are drawn, instead of those of the present one; one that has
  /// not moved since it was kept last is drawn once. What `still --strobe` shows.
  void keepMoment();
  /// Adds what is shown to a picture, without beginning a new one, and without title cards and fades.
  void paint(Picture& picture) const;

private:
  /// The last frame before the present one, when a moment between the two is shown.
  struct Earlier {
    std::int64_t frame = -1;
    std::vector<Body> bodies;
    std::uint64_t stateHash = 0;
  };
  void note(); ///< the present frame, to what remembers the past
  void blend(double fraction);
  /// The present frame's, between two steps where the scene's main loop has them so (World::shown()).
  [[nodiscard]] std::span<const Body> frameBodies() const;
  /// s of the video: of the last show(); before the first one it is the simulated time.
  [[nodiscard]] double videoTime() const;
  /// The pause that points at bodies now, or null.
  [[nodiscard]] const Film::Freeze* presentFreeze() const;
  [[nodiscard]] const Pause& pauseOf(const Film::Freeze& freeze) const;
  [[nodiscard]] std::span<const Body> drawnBodies() const;
  void drawBodies(Picture& picture, const Film::Freeze* freeze) const;
  void drawOverVeil(Picture& picture, const Film::Freeze& freeze, const OverlayPainter::Now& overlaid) const;
  void drawCard(Picture& picture) const;
  void drawFade(Picture& picture) const;

  Clock clock_;
  std::string title_;
  std::variant<World, ReplayMotion> motion_; ///< simulated or replayed
  std::optional<WatchedRun> watched_;
  Viewport home_; ///< without a camera
  Painter painter_;
  OverlayHistory history_;
  OverlayPainter overlays_;
  TextPainter textPainter_;
  PlotSet plots_;
  std::unique_ptr<PanelSet> panels_; ///< null: one world, `motion_`; else motion_ is not drawn
  SceneTexts texts_;
  TitleCard card_;
  Timeline timeline_;
  Film film_;
  Camera camera_;
  std::uint32_t ringLook_ = 0; ///< of the first pause; those of the others follow
  double ringWidth_ = 0.0;     ///< px of the scene
  std::uint64_t fingerprint_;  ///< of the scene's text, its clock, its images, its fonts and its sounds
  std::optional<World>
      start_; ///< the world at frame 0, where what stands beside the pictures needs its events

  Shot shot_{};
  bool followsShots_ = false; ///< show() was called
  bool interpolates_ = false;
  std::vector<Body> interpolated_; ///< of frameBodies()
  std::vector<Body> kept_;
  std::unordered_map<std::uint32_t, Vec2> keptAt_; ///< position by body
  Earlier earlier_;
  std::vector<Body> blended_; ///< what is shown between two frames
  std::map<std::uint32_t, Vec2>
      followed_; ///< by id: the centre of a body that the camera follows, now or last
};

} // namespace offstage
