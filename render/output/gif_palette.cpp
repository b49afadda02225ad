#include "render/output/gif_palette.h"

#include "render/output/nearest_color.h"

#include <algorithm>
#include <numeric>

namespace offstage {
namespace {

constexpr std::size_t kMostCounted = 131072;
constexpr std::size_t kMostColors = 255; ///< one of 256 is left for "unchanged"
/// Colours that fill areas: at most so many, and each at least this share of all pixels.
constexpr std::size_t kMostExact = 64;
constexpr std::uint64_t kExactShare = 2000;

using Entry = ColorHistogram::Entry;

/// A part of the colours, as a range of their list.
struct Box {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t channel = 0;  ///< the widest
  std::uint64_t extent = 0; ///< its width, weighted by how many pixels are in the box
};

Box boxOf(const std::vector<Entry>& entries, std::size_t begin, std::size_t end) {
  Box box{begin, end, 0, 0};
  std::uint64_t count = 0;
  for (std::size_t i = begin; i < end; ++i) count += entries[i].count;
  int widest = -1;
  for (std::size_t c = 0; c < 3; ++c) {
    int low = 255;
    int high = 0;
    for (std::size_t i = begin; i < end; ++i) {
      low = std::min<int>(low, entries[i].color[c]);
      high = std::max<int>(high, entries[i].color[c]);
    }
    const int width = (high - low) * kEyeWeights[c];
    if (width <= widest) continue;
    widest = width;
    box.channel = c;
  }
  box.extent = end - begin < 2 ? 0 : static_cast<std::uint64_t>(widest) * count;
  return box;
}

GifColor meanOf(const std::vector<Entry>& entries, const Box& box) {
  std::array<std::uint64_t, 3> sum{};
  std::uint64_t count = 0;
  for (std::size_t i = box.begin; i < box.end; ++i) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += entries[i].color[c] * entries[i].count;
    count += entries[i].count;
  }
  if (count == 0) return {};
  GifColor mean{};
  for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
  return mean;
}

/// Splits the box at the median of its widest channel.
std::size_t medianOf(std::vector<Entry>& entries, const Box& box) {
  const auto at = [&entries](std::size_t i) { return entries.begin() + static_cast<std::ptrdiff_t>(i); };
  std::stable_sort(at(box.begin), at(box.end), [&box](const Entry& a, const Entry& b) {
    return a.color[box.channel] < b.color[box.channel];
  });
  std::uint64_t count = 0;
  for (std::size_t i = box.begin; i < box.end; ++i) count += entries[i].count;
  std::uint64_t half = 0;
  std::size_t middle = box.begin;
  while (middle < box.end - 1 && 2 * half < count) half += entries[middle++].count;
  return std::clamp(middle, box.begin + 1, box.end - 1);
}

std::vector<GifColor> medianCut(std::vector<Entry> entries, std::size_t colors) {
  std::vector<Box> boxes{boxOf(entries, 0, entries.size())};
  while (boxes.size() < colors) {
    const auto widest = std::ranges::max_element(boxes, {}, &Box::extent);
    if (widest->extent == 0) break;
    const Box box = *widest;
    const std::size_t middle = medianOf(entries, box);
    *widest = boxOf(entries, box.begin, middle);
    boxes.push_back(boxOf(entries, middle, box.end));
  }
  std::vector<GifColor> palette;
  palette.reserve(boxes.size());
  for (const Box& box : boxes) palette.push_back(meanOf(entries, box));
  return palette;
}

} // namespace

void ColorHistogram::add(std::span<const std::uint8_t> rgba) {
  // Runs of one colour are counted at once.
  for (std::size_t i = 0; i + 4 <= rgba.size();) {
    const std::uint32_t key = keyOfColor(&rgba[i]);
    const std::uint8_t alpha = rgba[i + 3];
    std::uint64_t run = 0;
    do {
      ++run;
      i += 4;
    } while (i + 4 <= rgba.size() && keyOfColor(&rgba[i]) == key && rgba[i + 3] == alpha);
    if (alpha == 255) groups_[key & mask_].add(key, run, run);
    if (groups_.size() > kMostCounted) merge();
  }
}

void ColorHistogram::Group::add(std::uint32_t added, std::uint64_t addedCount, std::uint64_t all) {
  count += all;
  if (added == color) {
    colorCount += addedCount;
  } else if (addedCount > colorCount) {
    color = added;
    colorCount = addedCount;
  }
}

void ColorHistogram::merge() {
  mask_ = (mask_ << 1U) & mask_ & 0xFEFEFEU; // one bit less a channel
  ColorTable<Group> merged;
  groups_.forEach([&](std::uint32_t key, const Group& group) {
    merged[key & mask_].add(group.color, group.colorCount, group.count);
  });
  groups_ = std::move(merged);
}

std::vector<Entry> ColorHistogram::entries() const {
  std::vector<Entry> entries;
  entries.reserve(groups_.size());
  groups_.forEach([&](std::uint32_t /*key*/, const Group& group) {
    entries.push_back({colorOfKey(group.color), group.count});
  });
  std::ranges::sort(entries, {}, &Entry::color);
  return entries;
}

std::vector<GifColor> makePalette(const ColorHistogram& histogram) {
  std::vector<Entry> entries = histogram.entries();
  std::vector<GifColor> palette;
  const auto keep = [&palette](const Entry& entry) { palette.push_back(entry.color); };
  if (entries.size() <= kMostColors) {
    std::ranges::for_each(entries, keep);
    return palette;
  }
  std::ranges::stable_sort(entries, std::ranges::greater(), &Entry::count);
  const std::uint64_t all =
      std::accumulate(entries.begin(), entries.end(), std::uint64_t{0},
                      [](std::uint64_t sum, const Entry& entry) { return sum + entry.count; });
  std::size_t exact = 0;
  while (exact < kMostExact && entries[exact].count * kExactShare > all) keep(entries[exact++]);
  entries.erase(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(exact));
  const std::vector<GifColor> others = medianCut(std::move(entries), kMostColors - exact);
  palette.insert(palette.end(), others.begin(), others.end());
  return palette;
}

} // namespace offstage
