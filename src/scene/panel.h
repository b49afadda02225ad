#pragma once

#include "src/scene/color.h"
#include "src/scene/diagnostic.h"
#include "src/scene/plot.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

struct Scene;

/// `[[panel]]`: the scene once more, with some of its tables changed.
struct Panel {
  std::string title{};                  ///< its caption; may be empty
  std::optional<Color> color{};         ///< of all its bodies, and of its caption
  std::shared_ptr<const Scene> scene{}; ///< with the changes; has no panels of its own
  SourceLocation where{};               ///< of its table, for messages; empty from C++
};

/// `[[panels.plot]]`: values of several panels in one diagram.
struct PanelPlot {
  Plot plot{};                       ///< lengths in px of the whole picture
  std::vector<std::size_t> panels{}; ///< by curve: whose values they are, an index into Panels::panels
};

/// Several worlds in one picture, in step. Lengths in scene px; Scene::size is the whole picture's.
struct Panels {
  enum class Layout : std::uint8_t {
    Grid,     ///< row by row from the upper left
    Overlaid, ///< all in the same place, the first below
  };
  std::vector<Panel> panels{}; ///< empty: the scene is one world
  Layout layout = Layout::Grid;
  int columns = 1;                      ///< of a grid
  double gap = 16.0;                    ///< px between panes and around them
  double caption = 0.0;                 ///< px: height of the line of the title above each pane
  std::array<double, 2> pane{640, 480}; ///< px: of each world
  std::vector<PanelPlot> plots{};       ///< over the whole picture

  /// Where pane number `index` lies: left, top, width, height in px of a picture of width × height px. It
  /// keeps its aspect and is centred in its cell, below its caption; overlaid, in the whole picture.
  [[nodiscard]] std::array<double, 4> place(std::size_t index, double width, double height) const;
  /// The cells that the last row of a grid leaves free: left, top, width, height in px of such a picture.
  /// Nothing when it leaves none.
  [[nodiscard]] std::optional<std::array<double, 4>> freeCells(double width, double height) const;
  /// The size of the whole picture in which every pane has its own size, px.
  [[nodiscard]] std::array<double, 2> naturalSize() const;
  [[nodiscard]] int rows() const;
};

} // namespace offstage
