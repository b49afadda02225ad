#include "src/scene/toml_depth.h"

#include <array>

namespace offstage {
namespace {

/// Number of characters of the string or comment that `text` begins with, 0 when it begins with neither.
std::size_t skippedLength(std::string_view text) {
  if (text.starts_with('#')) return text.find('\n') == std::string_view::npos ? text.size() : text.find('\n');
  if (!text.starts_with('"') && !text.starts_with('\'')) return 0;
  const char quote = text.front();
  const bool multiline = text.size() >= 3 && text[1] == quote && text[2] == quote;
  const std::size_t quotes = multiline ? 3 : 1;
  std::size_t i = quotes;
  while (i < text.size()) {
    if (quote == '"' && text[i] == '\\') {
      i += 2;
    } else if (!multiline && text[i] == '\n') {
      return i; // not closed: a syntax error
    } else if (text[i] == quote && (!multiline || text.substr(i, 3) == text.substr(0, 3))) {
      i += quotes;
      // Up to two more quotes belong to a multi-line string's text.
      while (multiline && i < text.size() && text[i] == quote) ++i;
      return i;
    } else {
      ++i;
    }
  }
  return text.size();
}

/// Where text[at] is.
TooDeep placeOf(std::string_view text, std::size_t at) {
  TooDeep place;
  for (const char byte : text.substr(0, at)) {
    if (byte == '\n') {
      ++place.line;
      place.column = 1;
    } else if ((static_cast<unsigned char>(byte) & 0xc0U) != 0x80U) { // not a continuation byte of UTF-8
      ++place.column;
    }
  }
  place.isKey = text[at] == '.';
  return place;
}

/// By byte: whether it can begin a string or a comment, end a key, nest or stand between a key's parts. The
/// rest, nearly all of a large scene, is passed over.
constexpr std::array<bool, 256> kMatters = [] {
  std::array<bool, 256> matters{};
  for (const char letter : std::string_view("#\"'.=,[]{}\n"))
    matters[static_cast<unsigned char>(letter)] = true;
  return matters;
}();

} // namespace

std::optional<TooDeep> findTooDeep(std::string_view text) {
  std::size_t dots = 0;
  std::size_t nested = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    const char letter = text[i];
    if (!kMatters[static_cast<unsigned char>(letter)]) {
      ++i;
      continue;
    }
    if (const std::size_t skipped = skippedLength(text.substr(i)); skipped > 0) {
      i += skipped;
      continue;
    }
    if (letter == '.') {
      if (++dots > kMaxDotsInKey) return placeOf(text, i);
    } else {
      dots = 0; // a key ends at any of these; between them stands one key or one number, which has one dot
    }
    if ((letter == '[' || letter == '{') && ++nested > kMaxNestedValues) return placeOf(text, i);
    if ((letter == ']' || letter == '}') && nested > 0) --nested;
    ++i;
  }
  return std::nullopt;
}

} // namespace offstage
