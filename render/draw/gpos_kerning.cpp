#include "render/draw/gpos_kerning.h"

#include <bit>
#include <set>

namespace offstage {
namespace {

constexpr std::uint32_t kKern = 0x6b65726eU; // "kern"
constexpr std::uint32_t kPairAdjustment = 2;
constexpr std::uint32_t kExtension = 9;
constexpr std::uint32_t kXAdvance = 0x0004U;

// No sound font has more; a table whose parts overlap could claim billions.
constexpr std::size_t kMostFeatureLookups = 1U << 16U;
constexpr std::size_t kMostSubtables = 4096;

/// Bytes of a value record: two for each bit that is set.
std::size_t valueSize(std::uint32_t format) {
  return 2U * static_cast<std::size_t>(std::popcount(format & 0xffU));
}

} // namespace

GposKerning::GposKerning(std::vector<std::uint8_t> table) : table_(std::move(table)) {
  const Place features = u16(6);
  const Place lookups = u16(8);
  if (features == 0 || lookups == 0) return;
  std::set<std::uint32_t> wanted; // features of several scripts share their lookups
  std::size_t seen = 0;
  for (std::uint32_t i = 0; i < u16(features); ++i) {
    const Place record = features + 2 + 6U * i;
    if (u32(record) != kKern) continue;
    const Place feature = features + u16(record + 4);
    for (std::uint32_t k = 0; k < u16(feature + 2) && seen < kMostFeatureLookups; ++k, ++seen)
      wanted.insert(u16(feature + 4 + 2U * k));
  }
  for (const std::uint32_t index : wanted) {
    if (index < u16(lookups)) addLookup(lookups + u16(lookups + 2 + 2U * index));
  }
}

void GposKerning::addLookup(Place lookup) {
  const std::uint32_t type = u16(lookup);
  std::vector<Place> subtables;
  for (std::uint32_t i = 0; i < u16(lookup + 4) && subtables_ < kMostSubtables; ++i, ++subtables_) {
    Place subtable = lookup + u16(lookup + 6 + 2U * i);
    std::uint32_t kind = type;
    if (type == kExtension) {
      kind = u16(subtable + 2);
      subtable += u32(subtable + 4);
    }
    if (kind == kPairAdjustment && subtable < table_.size()) subtables.push_back(subtable);
  }
  if (!subtables.empty()) lookups_.push_back(std::move(subtables));
}

std::uint32_t GposKerning::u16(Place at) const {
  if (at + 2 > table_.size()) return 0;
  return static_cast<std::uint32_t>(table_[at]) << 8U | table_[at + 1];
}

std::uint32_t GposKerning::u32(Place at) const {
  return u16(at) << 16U | u16(at + 2);
}

std::optional<std::uint32_t> GposKerning::coverage(Place table, std::uint32_t glyph) const {
  const std::uint32_t format = u16(table);
  std::uint32_t low = 0;
  std::uint32_t high = u16(table + 2);
  while (low < high) {
    const std::uint32_t middle = (low + high) / 2;
    const Place entry = table + 4 + (format == 1 ? 2U : 6U) * middle;
    const std::uint32_t first = u16(entry);
    const std::uint32_t last = format == 1 ? first : u16(entry + 2);
    if (glyph < first) {
      high = middle;
    } else if (glyph > last) {
      low = middle + 1;
    } else {
      return format == 1 ? middle : u16(entry + 4) + glyph - first;
    }
  }
  return std::nullopt;
}

std::uint32_t GposKerning::classOf(Place table, std::uint32_t glyph) const {
  if (u16(table) == 1) {
    const std::uint32_t first = u16(table + 2);
    return glyph >= first && glyph - first < u16(table + 4) ? u16(table + 6 + 2U * (glyph - first)) : 0;
  }
  std::uint32_t low = 0;
  std::uint32_t high = u16(table + 2);
  while (low < high) {
    const std::uint32_t middle = (low + high) / 2;
    const Place entry = table + 4 + 6U * middle;
    if (glyph < u16(entry)) {
      high = middle;
    } else if (glyph > u16(entry + 2)) {
      low = middle + 1;
    } else {
      return u16(entry + 4);
    }
  }
  return 0;
}

int GposKerning::advanceIn(Place value, std::uint32_t format) const {
  if ((format & kXAdvance) == 0) return 0;
  return static_cast<std::int16_t>(u16(value + valueSize(format & (kXAdvance - 1U))));
}

std::optional<int> GposKerning::inPairSet(Place table, std::uint32_t index, std::uint32_t right) const {
  const std::uint32_t format = u16(table + 4);
  const std::size_t size = 2 + valueSize(format) + valueSize(u16(table + 6));
  if (index >= u16(table + 8)) return std::nullopt;
  const Place pairs = table + u16(table + 10 + 2U * index);
  std::uint32_t low = 0;
  std::uint32_t high = u16(pairs);
  while (low < high) {
    const std::uint32_t middle = (low + high) / 2;
    const Place pair = pairs + 2 + size * middle;
    const std::uint32_t glyph = u16(pair);
    if (glyph == right) return advanceIn(pair + 2, format);
    (right < glyph ? high : low) = right < glyph ? middle : middle + 1;
  }
  return std::nullopt;
}

std::optional<int> GposKerning::inClasses(Place table, std::uint32_t left, std::uint32_t right) const {
  const std::uint32_t format = u16(table + 4);
  const std::size_t size = valueSize(format) + valueSize(u16(table + 6));
  const std::uint32_t first = classOf(table + u16(table + 8), left);
  const std::uint32_t second = classOf(table + u16(table + 10), right);
  const std::uint32_t columns = u16(table + 14);
  if (first >= u16(table + 12) || second >= columns) return std::nullopt;
  return advanceIn(table + 16 + size * (static_cast<std::size_t>(first) * columns + second), format);
}

std::optional<int> GposKerning::inSubtable(Place table, std::uint32_t left, std::uint32_t right) const {
  const auto index = coverage(table + u16(table + 2), left);
  if (!index) return std::nullopt;
  return u16(table) == 1 ? inPairSet(table, *index, right) : inClasses(table, left, right);
}

int GposKerning::find(std::uint32_t left, std::uint32_t right) const {
  int sum = 0;
  for (const std::vector<Place>& subtables : lookups_) {
    for (const Place subtable : subtables) {
      const auto found = inSubtable(subtable, left, right);
      if (!found) continue;
      sum += *found; // the first subtable that knows the pair ends its lookup
      break;
    }
  }
  return sum;
}

int GposKerning::between(std::uint32_t left, std::uint32_t right) const {
  const auto [entry, isNew] = found_.try_emplace({left, right}, 0);
  if (isNew) entry->second = find(left, right);
  return entry->second;
}

} // namespace offstage
