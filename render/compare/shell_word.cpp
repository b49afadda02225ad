#include "render/compare/shell_word.h"

#include <algorithm>
#include <string_view>

namespace offstage {

std::string shellWord(const std::string& text) {
  constexpr std::string_view kHarmless = "_-./@%+=:,";
  const bool plain = !text.empty() && std::ranges::all_of(text, [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kHarmless.find(c) != std::string_view::npos;
  });
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

} // namespace offstage
