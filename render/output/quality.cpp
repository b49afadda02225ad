#include "render/output/quality.h"

#include <algorithm>
#include <array>

namespace offstage {
namespace {

constexpr std::array<std::string_view, 4> kNames{"draft", "good", "high", "lossless"};

} // namespace

std::string_view qualityName(Quality quality) {
  return kNames.at(static_cast<std::size_t>(quality));
}

std::optional<Quality> qualityOfName(std::string_view name) {
  const auto* entry = std::ranges::find(kNames, name);
  if (entry == kNames.end()) return std::nullopt;
  return static_cast<Quality>(entry - kNames.begin());
}

} // namespace offstage
