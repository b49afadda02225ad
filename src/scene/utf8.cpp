#include "src/scene/utf8.h"

#include "src/scene/quote.h"
#include "src/sim/error.h"

#include <cstddef>

#include <fmt/core.h>

namespace offstage {
namespace {

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

[[noreturn]] void fail(std::string_view text, std::size_t at) {
  throw Error(ExitCode::BadInput,
              fmt::format("the text {} is not UTF-8 (byte {})", quotedText(text), at + 1));
}

} // namespace

std::u32string decodeUtf8(std::string_view text) {
  std::u32string characters;
  for (std::size_t i = 0; i < text.size();) {
    const Lead lead = leadOf(static_cast<unsigned char>(text[i]));
    if (lead.following < 0 || i + static_cast<std::size_t>(lead.following) >= text.size()) fail(text, i);
    char32_t character = lead.bits;
    for (int k = 1; k <= lead.following; ++k) {
      const auto byte = static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]);
      if ((byte & 0xc0U) != 0x80U) fail(text, i);
      character = character << 6U | (byte & 0x3fU);
    }
    const bool surrogate = character >= 0xd800 && character < 0xe000;
    if (character < lead.least || character > 0x10ffff || surrogate) fail(text, i);
    characters.push_back(character);
    i += static_cast<std::size_t>(lead.following) + 1;
  }
  return characters;
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
