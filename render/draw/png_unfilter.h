#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace offstage {

/// Bytes behind the last row that unfilterRows may read, and that its caller must have.
constexpr std::size_t kUnfilterSlack = 8;

/// Reverses the filters of `rows` rows in place (ISO/IEC 15948, 9). Each row is a filter byte and `rowBytes`
/// bytes; they follow each other without padding. `pixelBytes`: of a whole pixel, at least 1, at most 8. The
/// filter bytes stay. Returns the number of the first row whose filter is unknown, or nothing.
std::optional<int> unfilterRows(std::uint8_t* data, int rows, std::size_t rowBytes, int pixelBytes);

} // namespace offstage
