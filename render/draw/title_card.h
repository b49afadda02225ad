#pragma once

#include "render/draw/text_painter.h"
#include "src/scene/scene.h"

#include <string_view>

namespace offstage {

/// A section's title card: its title, and perhaps a second line, in the middle of the pane, over the theme's
/// background.
class TitleCard {
public:
  /// Holds every card of the scene against its font. Throws SceneError, located at the section, for a text
  /// that cannot be set, or Error(Environment) when the font is missing.
  TitleCard(const Scene& scene, const Viewport& viewport);

  /// `share` (0 … 1): how much of the card is there.
  void draw(Picture& picture, std::string_view title, std::string_view subtitle, double share) const;

private:
  Vec2 pane_; ///< px
  PixelRect clip_;
  Color background_;
  TextLook titleLook_;
  TextLook subtitleLook_;
  TextPainter painter_;
};

} // namespace offstage
