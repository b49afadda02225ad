#include "src/scene/utf8.h"

#include "src/scene/quote.h"
#include "src/sim/error.h"

#include <cstddef>
#include <optional>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD"; // U+FFFD

/// What a first byte says of its sequence: how many bytes follow, and its own bits of the character.
struct Lead {
  int following = -1; ///< −1: no first byte
  char32_t bits = 0;
  char32_t least = 0; ///< the first character that needs this length; below it the form is overlong
};

Lead leadOf(unsigned char byte) {
  if (byte < 0x80) return {0, byte, 0};
  if (byte < 0xc0) return {};
  if (byte < 0xe0) return {1, byte & 0x1fU, 0x80};
  if (byte < 0xf0) return {2, byte & 0x0fU, 0x800};
  if (byte < 0xf8) return {3, byte & 0x07U, 0x10000};
  return {};
}

/// The character at the start of a text, and how many bytes it takes; nothing where these are not UTF-8.
struct Decoded {
  char32_t character = 0;
  std::size_t length = 0;
};

std::optional<Decoded> decodeFirst(std::string_view text) {
  const Lead lead = leadOf(static_cast<unsigned char>(text.front()));
  if (lead.following < 0 || static_cast<std::size_t>(lead.following) >= text.size()) return std::nullopt;
  const std::size_t length = static_cast<std::size_t>(lead.following) + 1;
  char32_t character = lead.bits;
  for (std::size_t k = 1; k < length; ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    if ((byte & 0xc0U) != 0x80U) return std::nullopt;
    character = character << 6U | (byte & 0x3fU);
  }
  const bool surrogate = character >= 0xd800 && character < 0xe000;
  if (character < lead.least || character > 0x10ffff || surrogate) return std::nullopt;
  return Decoded{character, length};
}

[[noreturn]] void fail(std::string_view text, std::size_t at) {
  throw Error(ExitCode::BadInput,
              fmt::format("the text {} is not UTF-8 (byte {})", quotedText(text), at + 1));
}

} // namespace

std::u32string decodeUtf8(std::string_view text) {
  std::u32string characters;
  for (std::size_t i = 0; i < text.size();) {
    const std::optional<Decoded> decoded = decodeFirst(text.substr(i));
    if (!decoded) fail(text, i);
    characters.push_back(decoded->character);
    i += decoded->length;
  }
  return characters;
}

std::string repairedUtf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::optional<Decoded> decoded = decodeFirst(text);
    result += decoded ? text.substr(0, decoded->length) : kReplacement;
    text.remove_prefix(decoded ? decoded->length : 1);
  }
  return result;
}

std::string encodeUtf8(char32_t c) {
  const auto byte = [](char32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
  if (c < 0x80) return {byte(c)};
  if (c < 0x800) return {byte(0xc0U | c >> 6U), byte(0x80U | (c & 0x3fU))};
  if (c < 0x10000)
    return {byte(0xe0U | c >> 12U), byte(0x80U | (c >> 6U & 0x3fU)), byte(0x80U | (c & 0x3fU))};
  return {byte(0xf0U | c >> 18U), byte(0x80U | (c >> 12U & 0x3fU)), byte(0x80U | (c >> 6U & 0x3fU)),
          byte(0x80U | (c & 0x3fU))};
}

} // namespace offstage
