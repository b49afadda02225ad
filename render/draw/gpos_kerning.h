#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace offstage {

/// The kerning of a font's GPOS table, where OpenType fonts of today have it (FreeType reads the older table
/// "kern" only): the pair adjustments of all features "kern", as a change of the left glyph's advance. Source
/// of the tables' forms: OpenType 1.9, chapters GPOS and "OpenType Layout Common Table Formats". A damaged
/// table kerns less, or not at all; nothing is read beyond its end.
class GposKerning {
public:
  GposKerning() = default;
  explicit GposKerning(std::vector<std::uint8_t> table);

  [[nodiscard]] bool empty() const { return lookups_.empty(); }
  /// Font units.
  [[nodiscard]] int between(std::uint32_t left, std::uint32_t right) const;

private:
  using Place = std::size_t; ///< from the table's beginning

  [[nodiscard]] std::uint32_t u16(Place at) const; ///< 0 beyond the end
  [[nodiscard]] std::uint32_t u32(Place at) const;
  void addLookup(Place lookup);
  /// The index of a glyph in a Coverage table.
  [[nodiscard]] std::optional<std::uint32_t> coverage(Place table, std::uint32_t glyph) const;
  [[nodiscard]] std::uint32_t classOf(Place table, std::uint32_t glyph) const;
  /// A PairPos subtable's answer; nothing when it says nothing of this pair.
  [[nodiscard]] std::optional<int> inSubtable(Place table, std::uint32_t left, std::uint32_t right) const;
  [[nodiscard]] std::optional<int> inPairSet(Place table, std::uint32_t index, std::uint32_t right) const;
  [[nodiscard]] std::optional<int> inClasses(Place table, std::uint32_t left, std::uint32_t right) const;
  /// The change of the advance in a value record of this format.
  [[nodiscard]] int advanceIn(Place value, std::uint32_t format) const;
  [[nodiscard]] int find(std::uint32_t left, std::uint32_t right) const;

  std::vector<std::uint8_t> table_;
  std::vector<std::vector<Place>> lookups_; ///< their PairPos subtables
  std::size_t subtables_ = 0;               ///< that were looked at, of any kind
  mutable std::map<std::pair<std::uint32_t, std::uint32_t>, int> found_;
};

} // namespace offstage
