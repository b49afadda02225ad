#pragma once

#include "render/raster/display_list.h"
#include "render/raster/draw_queue.h"
#include "render/raster/tile_set.h"

#include <limits>
#include <vector>

namespace offstage {

/// Redraws some tiles of a frame: the background there, and of every layer what lies in them, from the
/// topmost one that hides the rest. Tiles are put together to squares, which GL draws as points.
class PartialRedraw {
public:
  /// The canvas that is drawn on.
  struct Target {
    int width;          ///< px
    int height;         ///< px
    int largestPoint;   ///< px a side
    bool groundIsExact; ///< GroundCheck: discs may be laid over the background without blending
  };

  /// Fills the queue. False when a full redraw is estimated to cost less; the queue then holds nothing of
  /// use.
  bool collect(const DisplayList& list, const TileSet& tiles, const Target& target, DrawQueue& queue);

private:
  static constexpr std::int32_t kBackground = -1;
  static constexpr std::int32_t kDrawn = std::numeric_limits<std::int32_t>::max();
  struct Square {
    PixelRect rect;
    std::int32_t lowest = kBackground; ///< the first layer that is seen in it; kDrawn: nothing is left to do
    std::uint32_t above = 0;           ///< layers that are seen over the lowest
  };
  /// A layer that touches a square; below the square's lowest one it is not seen.
  struct Hit {
    std::size_t square;
    std::size_t layer;
  };

  void split(const TileSet& tiles);
  void findHits(const DisplayList& list);
  template <typename Visit>
  void visitSquares(const PixelRect& bounds, Visit visit);

  int columns_ = 0;
  std::vector<Square> squares_;        ///< cell after cell
  std::vector<std::size_t> cellStart_; ///< a cell's first square; one more at the end
  std::vector<Hit> hits_;              ///< in the layers' order
  std::vector<PixelRect> rects_;       ///< scratch
};

/// What a full redraw costs, and what PartialRedraw compares itself with: an estimate in ns, from
/// measurements of llvmpipe with one thread.
double fullRedrawCost(const DisplayList& list, int width, int height);

} // namespace offstage
