#pragma once

#include "src/sim/vec.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// What a user can do.
enum class InputAction : std::uint8_t { KeyDown, KeyUp, ButtonDown, ButtonUp, Mouse };

/// One thing that a user did.
struct InputEvent {
  double time = 0.0; ///< s since the start
  InputAction action = InputAction::Mouse;
  std::string
      name{}; ///< of a key, in any spelling ("SPACE", as JavaFX's KeyCode has it); a button's "left" …
  Vec2 mouse = Vec2::Zero(); ///< px of the pane, y down: where the pointer is from then on (or was already)
};

/// A recorded game: what its user did, in order of time. A text file with one event a line, its time in s
/// first:
///
///   0.50 key down SPACE
///   0.62 key up SPACE
///   1.00 mouse 320 240
///   1.05 button down left       (or middle, right)
///   1.20 button up left
///
/// Empty lines and lines that begin with '#' are skipped; times must not go back.
class InputLog {
public:
  /// Throws SceneError with file:line:column for every line that is no event.
  static InputLog read(const std::filesystem::path& file);
  /// The same from text; `file` is used in messages.
  static InputLog parse(std::string_view text, const std::filesystem::path& file);

  [[nodiscard]] const std::vector<InputEvent>& events() const { return events_; }
  /// Where the pointer is at a time; (0, 0) before it was anywhere.
  [[nodiscard]] Vec2 mouseAt(double time) const;
  /// When a key (KeyDown) or a button (ButtonDown) went down. One that is down already, as keys that repeat
  /// are, does not go down again.
  [[nodiscard]] std::vector<double> presses(InputAction action, std::string_view name) const;

private:
  std::vector<InputEvent> events_;
};

} // namespace offstage
