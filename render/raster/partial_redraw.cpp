#include "render/raster/partial_redraw.h"

#include "render/raster/cover.h"
#include "render/raster/framebuffer.h"
#include "render/raster/ground_check.h"

#include <algorithm>

namespace offstage {
namespace {

// ns, measured on Mesa 22.3.6 with AVX-512; of a point about what is left since it is drawn as a rectangle
constexpr double kPointCost = 100.0;
constexpr double kQuadCost = 900.0;
constexpr double kBlendedPixelCost = 5.5;
constexpr double kWholePixelCost = 1.8;
constexpr double kFramePixelCost = 0.55; ///< cleared and read

double cost(const ProgramKind& program, const PixelRect& rect) {
  const double pixels = static_cast<double>(rect.right - rect.left) * (rect.bottom - rect.top);
  return (program.footprint == Footprint::Point ? kPointCost : kQuadCost) +
         pixels * (program.coverage == Coverage::Whole ? kWholePixelCost : kBlendedPixelCost);
}

Instance wholeInstance(Rgba8 premultiplied) {
  Instance instance;
  instance.color = {premultiplied.r, premultiplied.g, premultiplied.b, premultiplied.a};
  return instance;
}

/// Where it is best to shade `part`, which lies in `rect`: there alone, or in a square around it, which costs
/// more pixels but may be a point.
PixelRect cheapest(const PixelRect& part, const PixelRect& rect, int largestPoint, ProgramKind& program) {
  const int side = std::max(part.right - part.left, part.bottom - part.top);
  const int left = std::max(std::min(part.left, rect.right - side), rect.left);
  const int top = std::max(std::min(part.top, rect.bottom - side), rect.top);
  const PixelRect square{left, top, left + side, top + side};
  ProgramKind point = program;
  point.footprint = Footprint::Point;
  program.footprint = Footprint::Quad;
  if (side > largestPoint || !holds(rect, square) || cost(point, square) > cost(program, part)) return part;
  program = point;
  return square;
}

/// Cuts the part of `square` that lies in `limits` out of a layer, of which nothing is outside `bounds`.
/// Nothing is left of it: an empty rectangle.
PixelRect cut(const PixelRect& square, const PixelRect& limits, const PixelRect& bounds, int largestPoint,
              ProgramKind& program, Instance& instance) {
  const PixelRect allowed = common(square, limits);
  const PixelRect part = common(allowed, bounds);
  if (part.empty()) return part;
  const PixelRect rect = cheapest(part, allowed, largestPoint, program);
  instance.quad = {static_cast<std::uint16_t>(rect.left), static_cast<std::uint16_t>(rect.top),
                   static_cast<std::uint16_t>(rect.right), static_cast<std::uint16_t>(rect.bottom)};
  return rect;
}

} // namespace

double fullRedrawCost(const DisplayList& list, int width, int height) {
  double sum = kFramePixelCost * width * height;
  for (const Layer& layer : list.layers)
    if (layer.visible) sum += cost(layer.program, layer.bounds());
  return sum;
}

bool PartialRedraw::collect(const DisplayList& list, const TileSet& tiles, const Target& target,
                            DrawQueue& queue) {
  split(tiles);
  findHits(list);
  const PixelRect frame{0, 0, target.width, target.height};
  const double most = fullRedrawCost(list, target.width, target.height);
  double spent = 0.0;
  const auto draw = [&](const PixelRect& square, const PixelRect& limits, const PixelRect& bounds,
                        ProgramKind program, Instance instance) {
    const PixelRect rect = cut(square, limits, bounds, target.largestPoint, program, instance);
    if (rect.empty()) return;
    queue.add(program, instance);
    spent += cost(program, rect);
  };
  const Rgba8 background = premultiplied(list.background);
  const auto standsOnGround = [&](const Hit& hit) {
    const Square& square = squares_[hit.square];
    const ProgramKind& program = list.layers[hit.layer].program;
    return target.groundIsExact && square.lowest == kBackground && square.above == 1 &&
           program.coverage == Coverage::Disc && program.paint == PaintSource::Color &&
           holds(list.layers[hit.layer].clip, square.rect);
  };

  for (const Hit& hit : hits_) {
    if (!standsOnGround(hit)) continue;
    Square& square = squares_[hit.square];
    const Layer& layer = list.layers[hit.layer];
    ProgramKind program = layer.program;
    program.coverage = Coverage::DiscOnGround;
    Instance instance = layer.instance;
    instance.inner = groundOf(background);
    draw(square.rect, frame, frame, program, instance);
    square.lowest = kDrawn;
  }
  for (const Square& square : squares_) {
    if (square.lowest == kDrawn) continue;
    const Rgba8 color = square.lowest == kBackground
                            ? background
                            : list.primitives[static_cast<std::size_t>(square.lowest)].color;
    draw(square.rect, frame, frame, {Coverage::Whole, PaintSource::Color, Footprint::Point},
         wholeInstance(color));
  }
  for (const Hit& hit : hits_) {
    const Square& square = squares_[hit.square];
    if (square.lowest == kDrawn || static_cast<std::int32_t>(hit.layer) < square.lowest) continue; // hidden
    const Layer& layer = list.layers[hit.layer];
    draw(square.rect, layer.clip, layer.bounds(), layer.program, layer.instance);
    if (spent > most) return false;
  }
  return spent <= most;
}

void PartialRedraw::findHits(const DisplayList& list) {
  hits_.clear();
  for (std::size_t i = 0; i < list.layers.size(); ++i) {
    if (!list.layers[i].visible) continue;
    const CoverTest test(list.primitives[i]);
    const bool plain = isPlain(list.primitives[i]);
    visitSquares(list.layers[i].bounds(), [&](Square& square) {
      const Cover cover = test.of(square.rect);
      if (cover == Cover::None) return;
      // Beyond the clip the background shows, whatever covers the square.
      if (cover == Cover::Whole && plain && holds(list.layers[i].clip, square.rect)) {
        square.lowest = static_cast<std::int32_t>(i);
        square.above = 0;
      } else {
        ++square.above;
        hits_.push_back({static_cast<std::size_t>(&square - squares_.data()), i});
      }
    });
  }
}

/// The squares that the tiles make up.
void PartialRedraw::split(const TileSet& tiles) {
  squares_.clear();
  cellStart_.clear();
  columns_ = tiles.columns();
  for (int row = 0; row < tiles.rows(); ++row) {
    for (int column = 0; column < columns_; ++column) {
      cellStart_.push_back(squares_.size());
      rects_.clear();
      appendSquares(tiles.cell(column, row), column, row, rects_);
      for (const PixelRect& rect : rects_) squares_.push_back({.rect = rect});
    }
  }
  cellStart_.push_back(squares_.size());
}

template <typename Visit>
void PartialRedraw::visitSquares(const PixelRect& bounds, Visit visit) {
  const PixelRect cells = TileSet::cellsOf(bounds);
  for (int row = cells.top; row < cells.bottom; ++row) {
    const auto line = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    const std::size_t first = cellStart_[line + static_cast<std::size_t>(cells.left)];
    const std::size_t last = cellStart_[line + static_cast<std::size_t>(cells.right)];
    for (std::size_t i = first; i < last; ++i) visit(squares_[i]);
  }
}

} // namespace offstage
