#include "src/scene/panel.h"

#include <algorithm>

namespace offstage {

int Panels::rows() const {
  return (static_cast<int>(panels.size()) + columns - 1) / columns;
}

std::array<double, 2> Panels::naturalSize() const {
  if (layout == Layout::Overlaid) return pane;
  return {columns * pane[0] + (columns + 1) * gap, rows() * (caption + pane[1]) + (rows() + 1) * gap};
}

std::array<double, 4> Panels::place(std::size_t index, double width, double height) const {
  if (layout == Layout::Overlaid) return {0.0, 0.0, width, height};
  const int column = static_cast<int>(index) % columns;
  const int row = static_cast<int>(index) / columns;
  const double cellWidth = (width - (columns + 1) * gap) / columns;
  const double cellHeight = (height - (rows() + 1) * gap) / rows();
  const double left = gap + column * (cellWidth + gap);
  const double top = gap + row * (cellHeight + gap) + caption;
  const double scale = std::min(cellWidth / pane[0], (cellHeight - caption) / pane[1]);
  const double paneWidth = scale * pane[0];
  const double paneHeight = scale * pane[1];
  return {left + 0.5 * (cellWidth - paneWidth), top + 0.5 * (cellHeight - caption - paneHeight), paneWidth,
          paneHeight};
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
