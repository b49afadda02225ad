#include "render/stage/input.h"

#include <algorithm>

namespace offstage {

bool Input::contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::span<const InputEvent> Input::events() const {
  if (!log_) return {};
  return std::span(log_->events()).subspan(first_, next_ - first_);
}

void Input::advance(double time) {
  pressedKeys_.clear();
  pressedButtons_.clear();
  if (!log_) return;
  const std::vector<InputEvent>& events = log_->events();
  const auto press = [](Names& held, Names& pressed, const std::string& name) {
    if (contains(held, name)) return;
    held.push_back(name);
    pressed.push_back(name);
  };
  first_ = next_;
  for (; next_ < events.size() && events[next_].time <= time; ++next_) {
    const InputEvent& event = events[next_];
    mouse_ = event.mouse;
    switch (event.action) {
    case InputAction::KeyDown:
      press(keys_, pressedKeys_, event.name);
      break;
    case InputAction::KeyUp:
      std::erase(keys_, event.name);
      break;
    case InputAction::ButtonDown:
      press(buttons_, pressedButtons_, event.name);
      break;
    case InputAction::ButtonUp:
      std::erase(buttons_, event.name);
      break;
    case InputAction::Mouse:
      break;
    }
  }
}

} // namespace offstage
