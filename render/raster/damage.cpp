#include "render/raster/damage.h"

#include "render/raster/cover.h"
#include "render/raster/instance_parts.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace offstage {
namespace {

/// One side of a change.
struct Side {
  const Primitive* primitive = nullptr; ///< null: there was, or is, nothing to be seen
  PixelRect bounds;
  PixelRect clip;
};

Side sideOf(const DisplayList& list, std::int32_t index) {
  if (index < 0) return {};
  const auto i = static_cast<std::size_t>(index);
  if (!list.layers[i].visible) return {};
  return {&list.primitives[i], list.layers[i].bounds(), list.layers[i].clip};
}

PixelRect united(const PixelRect& a, const PixelRect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

std::int64_t area(const PixelRect& rect) {
  return static_cast<std::int64_t>(rect.right - rect.left) * (rect.bottom - rect.top);
}

/// A change of one layer.
class Marker {
public:
  Marker(const Side& before, const Side& after, TileSet& tiles)
      : before_(before), after_(after), tiles_(tiles) {
    if (before.primitive != nullptr) coverBefore_.emplace(*before.primitive);
    if (after.primitive != nullptr) coverAfter_.emplace(*after.primitive);
    sameColor_ = before.primitive != nullptr && after.primitive != nullptr && before.primitive->pattern < 0 &&
                 after.primitive->pattern < 0 && before.primitive->color == after.primitive->color;
    hides_ = sameColor_ && isPlain(*before.primitive);
  }

  void mark() {
    const PixelRect both = united(before_.bounds, after_.bounds);
    if (both.empty()) return;
    if (area(both) <= area(before_.bounds) + area(after_.bounds)) {
      markIn(both);
    } else { // far apart: not all that lies between
      markIn(before_.bounds);
      markIn(after_.bounds);
    }
  }

private:
  enum class Verdict : std::uint8_t { Untouched, Hidden, Changed, Mixed };

  /// What lies beyond the clip is not covered, so a rectangle that it cuts is never covered wholly.
  static Cover coverOf(const std::optional<CoverTest>& test, const Side& side, const PixelRect& rect) {
    if (!test) return Cover::None;
    const Cover cover = test->of(rect);
    return cover == Cover::Whole && !holds(side.clip, rect) ? Cover::Some : cover;
  }

  [[nodiscard]] Verdict judge(const PixelRect& rect) const {
    const Cover before = coverOf(coverBefore_, before_, rect);
    const Cover after = coverOf(coverAfter_, after_, rect);
    if (before == Cover::Some || after == Cover::Some) return Verdict::Mixed;
    if (before == Cover::None && after == Cover::None) return Verdict::Untouched;
    if (before != after || !sameColor_) return Verdict::Changed;
    return hides_ ? Verdict::Hidden : Verdict::Untouched;
  }

  void markIn(const PixelRect& bounds) {
    const PixelRect cells = TileSet::cellsOf(bounds);
    for (int row = cells.top; row < cells.bottom; ++row) {
      for (int column = cells.left; column < cells.right; ++column) {
        const PixelRect place = TileSet::cellBounds(column, row);
        std::uint64_t& cell = tiles_.cell(column, row);
        switch (judge(place)) {
        case Verdict::Untouched:
          break;
        case Verdict::Hidden:
          cell = 0;
          break;
        case Verdict::Changed:
          cell = TileSet::kWhole;
          break;
        case Verdict::Mixed:
          markTiles(common(place, bounds), place, cell);
          break;
        }
      }
    }
  }

  void markTiles(const PixelRect& part, const PixelRect& place, std::uint64_t& cell) {
    constexpr int kTile = TileSet::kTile;
    for (int top = part.top / kTile * kTile; top < part.bottom; top += kTile) {
      for (int left = part.left / kTile * kTile; left < part.right; left += kTile) {
        const auto bit = static_cast<unsigned>((top - place.top) / kTile * 8 + (left - place.left) / kTile);
        const std::uint64_t tile = std::uint64_t{1} << bit;
        const Verdict verdict = judge({left, top, left + kTile, top + kTile});
        if (verdict == Verdict::Hidden) {
          cell &= ~tile;
        } else if (verdict != Verdict::Untouched) {
          cell |= tile;
        }
      }
    }
  }

  Side before_;
  Side after_;
  std::optional<CoverTest> coverBefore_;
  std::optional<CoverTest> coverAfter_;
  TileSet& tiles_;
  bool sameColor_ = false; ///< where both cover wholly, the layer has not changed
  bool hides_ = false;     ///< and nothing below it is seen there
};

/// Whether two layers are pieces of one straight line in one colour, which differ at most in where they end.
/// The shader computes a pixel from the line and tells by the ends only whose it is, so what both hold is the
/// same to the bit.
bool areOfOneLine(const Layer& before, const Layer& after) {
  return before.visible && after.visible && before.program.coverage == Coverage::Strip &&
         after.program.coverage == Coverage::Strip && before.instance.outer == after.instance.outer &&
         before.instance.color == after.instance.color && before.clip == after.clip;
}

/// The change of such a piece: of one that grows, what has grown.
void markEnds(const Side& before, const Side& after, TileSet& tiles) {
  const auto mark = [&](const Vec2& from, const Vec2& to) {
    Primitive between = *after.primitive;
    between.low = from;
    between.high = to;
    // A cut that is no right angle reaches farther than the ends, by less than the width of the line.
    const Vec2 reach = Vec2::Constant(2.0 * between.outer + 4.0);
    const PixelRect near = touchedPixels(from.cwiseMin(to) - reach, from.cwiseMax(to) + reach,
                                         united(before.bounds, after.bounds));
    Marker({}, {&between, near, after.clip}, tiles).mark();
  };
  const Primitive& x = *before.primitive;
  const Primitive& y = *after.primitive;
  if (x.low != y.low || x.innerLow != y.innerLow) mark(x.low, y.low);
  if (x.high != y.high || x.innerHigh != y.innerHigh) mark(x.high, y.high);
}

/// Takes away the tiles that an unchanged plain layer hides.
void hideUnder(const DisplayList& list, std::size_t index, TileSet& tiles) {
  constexpr int kTile = TileSet::kTile;
  const Primitive& primitive = list.primitives[index];
  if (!list.layers[index].visible || !isPlain(primitive)) return;
  const CoverTest test(primitive);
  const PixelRect cells = TileSet::cellsOf(list.layers[index].bounds());
  for (int row = cells.top; row < cells.bottom; ++row) {
    for (int column = cells.left; column < cells.right; ++column) {
      std::uint64_t& cell = tiles.cell(column, row);
      if (cell == 0) continue;
      const PixelRect place = TileSet::cellBounds(column, row);
      const Cover cover = test.of(place);
      const PixelRect& clip = list.layers[index].clip;
      if (cover == Cover::None) continue;
      if (cover == Cover::Whole && holds(clip, place)) {
        cell = 0;
        continue;
      }
      for (std::uint64_t rest = cell; rest != 0; rest &= rest - 1) {
        const int bit = std::countr_zero(rest);
        const int left = place.left + bit % 8 * kTile;
        const int top = place.top + bit / 8 * kTile;
        const PixelRect tile{left, top, left + kTile, top + kTile};
        if (holds(clip, tile) && test.of(tile) == Cover::Whole) {
          cell &= ~(std::uint64_t{1} << static_cast<unsigned>(bit));
        }
      }
    }
  }
}

} // namespace

void findDamage(const DisplayList& before, const DisplayList& now, const std::vector<LayerChange>& changes,
                TileSet& tiles) {
  auto change = changes.begin();
  const auto total = static_cast<std::int32_t>(now.layers.size());
  for (std::int32_t i = changes.empty() ? total : changes.front().position; i <= total; ++i) {
    bool changed = false;
    for (; change != changes.end() && change->position == i; ++change) {
      const Side was = sideOf(before, change->before);
      const Side is = sideOf(now, change->after);
      if (was.primitive != nullptr && is.primitive != nullptr &&
          areOfOneLine(before.layers[static_cast<std::size_t>(change->before)],
                       now.layers[static_cast<std::size_t>(change->after)]))
        markEnds(was, is, tiles);
      else
        Marker(was, is, tiles).mark();
      changed = changed || change->after == i;
    }
    if (changed || i == total) continue;
    hideUnder(now, static_cast<std::size_t>(i), tiles);
  }
}

} // namespace offstage
