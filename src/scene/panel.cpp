#include "src/scene/panel.h"

#include <algorithm>

namespace offstage {
namespace {

/// The pane as large as fits into a room of left, top, width, height, and in its middle.
std::array<double, 4> fitted(const std::array<double, 2>& pane, const std::array<double, 4>& room) {
  const double scale = std::min(room[2] / pane[0], room[3] / pane[1]);
  const double width = scale * pane[0];
  const double height = scale * pane[1];
  return {room[0] + 0.5 * (room[2] - width), room[1] + 0.5 * (room[3] - height), width, height};
}

} // namespace

int Panels::rows() const {
  return (static_cast<int>(panels.size()) + columns - 1) / columns;
}

std::array<double, 2> Panels::naturalSize() const {
  if (layout == Layout::Overlaid) return pane;
  return {columns * pane[0] + (columns + 1) * gap, rows() * (caption + pane[1]) + (rows() + 1) * gap};
}

std::array<double, 4> Panels::place(std::size_t index, double width, double height) const {
  if (layout == Layout::Overlaid) return fitted(pane, {0.0, 0.0, width, height});
  const int column = static_cast<int>(index) % columns;
  const int row = static_cast<int>(index) / columns;
  const double cellWidth = (width - (columns + 1) * gap) / columns;
  const double cellHeight = (height - (rows() + 1) * gap) / rows();
  const double left = gap + column * (cellWidth + gap);
  const double top = gap + row * (cellHeight + gap) + caption;
  return fitted(pane, {left, top, cellWidth, cellHeight - caption});
}

std::optional<std::array<double, 4>> Panels::freeCells(double width, double height) const {
  const int taken = static_cast<int>(panels.size()) % columns;
  if (layout == Layout::Overlaid || taken == 0) return std::nullopt;
  const double cellWidth = (width - (columns + 1) * gap) / columns;
  const double cellHeight = (height - (rows() + 1) * gap) / rows();
  const double left = gap + taken * (cellWidth + gap);
  return std::array{left, gap + (rows() - 1) * (cellHeight + gap), width - gap - left, cellHeight};
}

} // namespace offstage
