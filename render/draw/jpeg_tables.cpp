#include "render/draw/jpeg_tables.h"

#include <algorithm>
#include <numeric>

namespace offstage {
namespace {

// Markers of ITU-T T.81, table B.1: the second byte, after 0xff.
constexpr std::uint8_t kFirstRestart = 0xd0;
constexpr std::uint8_t kStartOfImage = 0xd8;
constexpr std::uint8_t kEndOfImage = 0xd9;
constexpr std::uint8_t kHuffmanTables = 0xc4;
constexpr std::uint8_t kStartOfScan = 0xda;

constexpr std::size_t kLengths = 16;    // code lengths of 1 to 16 bits
constexpr std::size_t kMostCodes = 256; // a code stands for a byte

/// The tables of one DHT segment: a byte of class and number, how many codes each length has, a byte a code.
bool segmentFits(std::span<const std::uint8_t> segment) {
  while (segment.size() > kLengths) {
    const std::span<const std::uint8_t> counts = segment.subspan(1, kLengths);
    const std::size_t codes = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (codes > kMostCodes) return false;
    if (segment.size() < 1 + kLengths + codes) return true; // cut off: the decoder finds that itself
    segment = segment.subspan(1 + kLengths + codes);
  }
  return segment.empty();
}

} // namespace

bool jpegTablesFit(std::span<const std::uint8_t> file) {
  if (file.empty() || file[0] != 0xff) return true;
  // The decoder takes fill bytes before the first marker, too.
  const auto first = std::ranges::find_if(file, [](std::uint8_t byte) { return byte != 0xff; });
  if (first == file.end() || *first != kStartOfImage) return true;
  for (auto at = static_cast<std::size_t>(first - file.begin()) + 1; at + 4 <= file.size();) {
    const std::uint8_t marker = file[at + 1];
    if (file[at] != 0xff || marker == 0xff) { // padding, or a fill byte
      ++at;
      continue;
    }
    if (marker == kEndOfImage) return true;
    const std::size_t length = static_cast<std::size_t>(file[at + 2]) << 8U | file[at + 3]; // counts itself
    if (length < 2) return true;
    const std::size_t begin = at + 4;
    const std::size_t end = at + 2 + length;
    if (marker == kHuffmanTables) {
      // A table may claim to reach beyond its segment, even beyond the file.
      if (!segmentFits(file.subspan(begin, std::min(end, file.size()) - begin))) return false;
      if (end > file.size()) return false;
    }
    at = end;
    if (marker != kStartOfScan) continue;
    // Coded data, up to the next marker that is neither a stuffed zero nor a restart.
    while (at + 1 < file.size()) {
      const std::uint8_t next = file[at + 1];
      const bool restart = next >= kFirstRestart && next < kStartOfImage;
      if (file[at] == 0xff && next != 0 && next != 0xff && !restart) break;
      ++at;
    }
  }
  return true;
}

} // namespace offstage
