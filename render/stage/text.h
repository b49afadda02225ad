#pragma once

#include "src/scene/text_look.h"
#include "src/sim/vec.h"

#include <cstdint>
#include <memory>
#include <string>

namespace offstage {

/// A text on the stage, drawn over all shapes; sharpest where it stands at a whole y. A Text is a handle, as
/// a Node is: a copy is the same text. It is no part of the state hash.
class Text {
public:
  /// `x`, `y` (px): where the look's anchor is, at first the text's centre. `size`: px an em.
  Text(double x, double y, std::string text, double size = 24.0, const Color& color = Color{});

  /// UTF-8; a line break is a line break. A character that the font lacks is an error when it is drawn.
  void setText(std::string text);
  void setPosition(const Vec2& position);
  void setColor(const Color& color);
  void setAnchor(NinePosition anchor); ///< and aligns lines to its side
  void setLook(const TextLook& look);  ///< everything but text and position
  void setVisible(bool visible);       ///< an invisible text stays on the stage

  [[nodiscard]] const std::string& text() const { return state_->text; }
  [[nodiscard]] Vec2 position() const { return state_->position; }
  [[nodiscard]] const TextLook& look() const { return state_->look; }
  [[nodiscard]] bool visible() const { return state_->visible; }

  /// The same text, not one that says the same.
  friend bool operator==(const Text& a, const Text& b) { return a.state_ == b.state_; }

private:
  struct State {
    std::string text;
    Vec2 position = Vec2::Zero(); ///< px
    TextLook look;
    bool visible = true;
    std::uint64_t version = 1; ///< counts changes of text and look, so that each is checked only once
  };
  friend class StageSource;
  std::shared_ptr<State> state_;
};

} // namespace offstage
