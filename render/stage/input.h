#pragma once

#include "src/scene/input_log.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// What the user of a recorded game does, as an exercise's frame() sees it: all that has happened up to
/// stage.time(). Without a recording nothing ever happens.
class Input {
public:
  /// Whether a key is down, by its name in the recording ("SPACE").
  [[nodiscard]] bool isDown(std::string_view key) const { return contains(keys_, key); }
  /// Whether it went down since the frame before; a key that is held does so once.
  [[nodiscard]] bool wentDown(std::string_view key) const { return contains(pressedKeys_, key); }
  /// The same of a button of the mouse: "left", "middle", "right".
  [[nodiscard]] bool isButtonDown(std::string_view button) const { return contains(buttons_, button); }
  [[nodiscard]] bool buttonWentDown(std::string_view button) const {
    return contains(pressedButtons_, button);
  }
  [[nodiscard]] Vec2 mouse() const { return mouse_; } ///< px of the pane; (0, 0) until it has been anywhere
  /// All that has happened since the frame before, in order.
  [[nodiscard]] std::span<const InputEvent> events() const;

private:
  friend class StageSource;
  using Names = std::vector<std::string>;
  static bool contains(const Names& names, std::string_view name);
  void advance(double time); ///< to the frame at this time, s

  std::shared_ptr<const InputLog> log_; ///< null: none
  std::size_t first_ = 0, next_ = 0;    ///< the frame's events: from first_ up to next_
  Names keys_, buttons_, pressedKeys_, pressedButtons_;
  Vec2 mouse_ = Vec2::Zero();
};

} // namespace offstage
