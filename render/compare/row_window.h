#pragma once

#include "render/draw/pixel_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace offstage {

/// The rows y − 2 … y + 2 of a picture as RGBA words (red in the lowest byte), for rules that look at
/// neighbours. Moves downwards; each row is converted once.
class RowWindow {
public:
  static constexpr int kReach = 2; ///< rows above and below

  explicit RowWindow(const PixelRows& rows)
      : rows_(rows), buffers_(kRows, std::vector<std::uint32_t>(static_cast<std::size_t>(rows.width()))) {}

  void moveTo(int y) {
    y_ = y;
    for (int row = std::max(0, y - kReach); row <= std::min(rows_.height() - 1, y + kReach); ++row) {
      const std::size_t slot = slotOf(row);
      if (held_[slot] == row) continue;
      auto* buffer = reinterpret_cast<std::uint8_t*>(buffers_[slot].data());
      const std::uint8_t* from = rows_.row8(row, buffer);
      // Stored rows may lie at odd addresses, so they are copied.
      if (from != buffer) std::memcpy(buffer, from, 4UL * buffers_[slot].size());
      held_[slot] = row;
    }
  }

  [[nodiscard]] int width() const { return rows_.width(); }
  [[nodiscard]] int height() const { return rows_.height(); }
  [[nodiscard]] int y() const { return y_; }
  /// A row within reach of y() and within the picture.
  [[nodiscard]] const std::uint32_t* row(int y) const { return buffers_[slotOf(y)].data(); }

private:
  static constexpr std::size_t kRows = 2 * kReach + 1;
  static std::size_t slotOf(int row) { return static_cast<std::size_t>(row) % kRows; }

  const PixelRows& rows_;
  std::vector<std::vector<std::uint32_t>> buffers_;
  std::array<int, kRows> held_{-1, -1, -1, -1, -1};
  int y_ = 0;
};

} // namespace offstage
