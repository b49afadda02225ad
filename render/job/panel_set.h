#pragma once

#include "render/draw/picture.h"
#include "render/draw/text_painter.h"
#include "src/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

class SceneSource;
class WarningLog;

/// The worlds of a scene with panels, in step.
class PanelSet {
public:
  /// `whole`: how the picture of Scene::size lies on the output.
  PanelSet(const Scene& scene, const Viewport& whole);
  ~PanelSet();
  PanelSet(const PanelSet&) = delete;
  PanelSet& operator=(const PanelSet&) = delete;

  /// What is wrong with the run of a world goes to `log`: SceneSource::watch(). `scene` is that of the
  /// constructor.
  void watch(const Scene& scene, WarningLog& log);
  /// Each world goes on to its last frame that is due at `time` (s).
  void stepTo(double time);
  /// Keeps the present bodies to be drawn, too: SceneSource::keepMoment().
  void keepMoment();
  /// Adds all worlds to a picture, each inside its pane.
  void draw(Picture& picture) const;
  [[nodiscard]] std::vector<std::int64_t> frames() const; ///< the present one of each world
  [[nodiscard]] std::uint64_t stateHash() const;          ///< of all worlds
  [[nodiscard]] std::uint64_t fingerprint() const;
  [[nodiscard]] const SceneSource& first() const { return *worlds_.front(); }

private:
  void frame(Picture& picture, const PixelRect& pane) const;
  void makeCaptions(const Scene& scene);
  void drawCaptions(Picture& picture) const;

  std::vector<std::unique_ptr<SceneSource>> worlds_;
  double frameWidth_ = 0.0; ///< px: of the line around each pane; 0: none
  double frameInset_ = 0.0; ///< output px of it that lie on the pane
  Rgba8 frameColor_;
  struct Caption {
    std::string text;
    TextLook look;
    Vec2 at;                  ///< px of the whole picture
    std::optional<Color> dot; ///< before the text, in this colour
  };
  Viewport viewport_; ///< of the whole picture
  TextPainter texts_;
  std::vector<Caption> captions_;
};

} // namespace offstage
