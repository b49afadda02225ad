#pragma once

#include "render/draw/overlay_history.h"
#include "render/draw/overlay_painter.h"
#include "render/draw/painter.h"
#include "render/draw/text_painter.h"
#include "render/job/render_options.h"
#include "render/job/source.h"
#include "render/job/warning_log.h"
#include "render/stage/exercise.h"

#include <memory>
#include <vector>

namespace offstage {

/// An exercise as something to render.
class StageSource : public Source {
public:
  /// Calls the exercise's settings() and start(). Throws Error(BadInput) for settings or options that cannot
  /// be.
  StageSource(std::unique_ptr<Exercise> exercise, const RenderOptions& options);

  /// From here on shapes that are nowhere (NotFinite) are reported to `log`, which outlives this. All else
  /// that a scene's run is watched for, an exercise computes by itself.
  void watch(WarningLog& log);

  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] const std::string& title() const override { return stage_.settings_.title; }
  [[nodiscard]] std::int64_t frame() const override { return stage_.frame(); }
  void step() override;
  void draw(Picture& picture) const override;
  [[nodiscard]] std::uint64_t stateHash() const override;
  /// Of the clock and the recorded input: all else of an exercise is the program and its options.
  [[nodiscard]] std::uint64_t fingerprint() const override;

private:
  /// Gives every shape whose look is new or has changed its place among the painter's looks.
  void prepareLooks();
  void noteFrame(); ///< to what overlays remember
  void checkShapes();
  /// Holds every new or changed text against its font.
  void checkTexts();

  std::unique_ptr<Exercise> exercise_;
  Clock clock_;
  std::filesystem::path inputFile_; ///< empty: none
  Stage stage_;
  Painter painter_;
  std::vector<Body> bodies_; ///< the shapes as overlays see them
  OverlayHistory history_;
  OverlayPainter overlays_;
  TextPainter textPainter_;
  WarningLog* log_ = nullptr; ///< null: nobody watches, or there is nothing more to tell
};

} // namespace offstage
