#include "src/scene/toml_depth.h"

#include <algorithm>

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

void advance(TooDeep& position, std::string_view passed) {
  for (const char byte : passed) {
    if (byte == '\n') {
      ++position.line;
      position.column = 1;
    } else if ((static_cast<unsigned char>(byte) & 0xc0U) != 0x80U) { // not a continuation byte of UTF-8
      ++position.column;
    }
  }
}

} // namespace

std::optional<TooDeep> findTooDeep(std::string_view text) {
  TooDeep position;
  std::size_t dots = 0;
  std::size_t nested = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    std::size_t length = std::min(skippedLength(text.substr(i)), text.size() - i);
    if (length == 0) {
      length = 1;
      const char letter = text[i];
      // A key ends at any of these; between them stands one key or one number, which has one dot.
      if (std::string_view("=,[]{}\n").find(letter) != std::string_view::npos) dots = 0;
      position.isKey = letter == '.';
      if (position.isKey && ++dots > kMaxDotsInKey) return position;
      if ((letter == '[' || letter == '{') && ++nested > kMaxNestedValues) return position;
      if ((letter == ']' || letter == '}') && nested > 0) --nested;
    }
    advance(position, text.substr(i, length));
    i += length;
  }
  return std::nullopt;
}

} // namespace offstage
