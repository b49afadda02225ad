#pragma once

#include "src/scene/number_format.h"
#include "src/sim/probe.h"

#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// A text with live values in braces: "v = {ball.speed:.1f} px/s". `{{` and `}}` are braces themselves.
struct TextTemplate {
  struct Piece {
    std::string text;           ///< what stands before the value
    std::optional<Probe> probe; ///< nothing in a last piece that ends with its text
    NumberFormat format;
  };
  std::vector<Piece> pieces;

  [[nodiscard]] bool live() const;
  [[nodiscard]] std::string text(const Snapshot& snapshot) const;
};

} // namespace offstage
