#include "render/stage/text.h"

#include <utility>

namespace offstage {

Text::Text(double x, double y, std::string text, double size, const Color& color)
    : state_(std::make_shared<State>()) {
  state_->text = std::move(text);
  state_->position = {x, y};
  state_->look.size = size;
  state_->look.color = color;
}

void Text::setText(std::string text) {
  if (text == state_->text) return;
  state_->text = std::move(text);
  ++state_->version;
}

void Text::setPosition(const Vec2& position) {
  state_->position = position;
}

void Text::setColor(const Color& color) {
  state_->look.color = color;
}

void Text::setAnchor(NinePosition anchor) {
  state_->look.anchor = anchor;
  state_->look.align = sideOf(anchor);
}

void Text::setLook(const TextLook& look) {
  state_->look = look;
  ++state_->version;
}

void Text::setVisible(bool visible) {
  state_->visible = visible;
}

} // namespace offstage
