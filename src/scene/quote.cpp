#include "src/scene/quote.h"

#include <charconv>
#include <cmath>
#include <cstddef>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr std::size_t kShownBytes = 60;

bool isContinuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U;
}

/// Length of the UTF-8 sequence that `text` begins with; 0 when it begins with none (RFC 3629, section 4,
/// where lengths and lead bytes come from; overlong forms and surrogates pass, for they are harmless to
/// show).
std::size_t sequenceLength(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!isContinuation(text[i])) return 0;
  }
  return length;
}

bool isControl(std::string_view sequence) {
  const auto lead = static_cast<unsigned char>(sequence.front());
  if (sequence.size() == 1) return lead < 0x20 || lead == 0x7f;
  return lead == 0xc2 && static_cast<unsigned char>(sequence[1]) < 0xa0; // C1 controls
}

} // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequenceLength(text);
    const std::string_view sequence = text.substr(0, length == 0 ? 1 : length);
    if (length == 0 || isControl(sequence)) {
      for (const char byte : sequence) result += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    } else {
      result += sequence;
    }
    text.remove_prefix(sequence.size());
  }
  return result;
}

std::string quotedText(std::string_view text) {
  if (text.size() <= kShownBytes) return '"' + printable(text) + '"';
  std::size_t cut = kShownBytes;
  while (cut > 0 && isContinuation(text[cut])) --cut; // never within a character
  return '"' + printable(text.substr(0, cut)) + "…\"";
}

std::string numberText(double value) {
  if (std::isnan(value)) return "nan"; // whatever its sign, in which processors differ
  char digits[32];
  const bool isWhole = std::trunc(value) == value && std::fabs(value) < 1e15;
  const auto [end, error] =
      isWhole ? std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed)
              : std::to_chars(digits, digits + sizeof digits, value);
  return error == std::errc() ? std::string(digits, end) : std::string();
}

} // namespace offstage
