#include "src/scene/nearest.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

namespace offstage {
namespace {

/// Longer words are nobody's typo; the bound also keeps the distance's tables on the stack.
constexpr std::size_t kLongestWord = 40;

char lower(char letter) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

/// Optimal string alignment distance of two words of at most kLongestWord letters each.
std::size_t distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, kLongestWord + 1>;
  Row beforePrevious{};
  Row previous{};
  Row current{};
  for (std::size_t j = 0; j <= b.size(); ++j) previous.at(j) = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current.at(0) = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      std::size_t best = previous.at(j - 1) + (same ? 0 : 1);
      best = std::min({best, previous.at(j) + 1, current.at(j - 1) + 1});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) best = std::min(best, beforePrevious.at(j - 2) + 1);
      current.at(j) = best;
    }
    beforePrevious = previous;
    previous = current;
  }
  return previous.at(b.size());
}

} // namespace

std::string_view nearest(std::string_view text, std::span<const std::string_view> candidates) {
  if (text.empty() || text.size() > kLongestWord) return {};
  std::string_view best;
  std::size_t bestDistance = std::max<std::size_t>(1, text.size() / 3) + 1;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestWord) continue;
    const std::size_t candidateDistance = distance(text, candidate);
    // A word whose every letter was replaced is another word, however short it is.
    if (candidateDistance >= std::max(text.size(), candidate.size())) continue;
    if (candidateDistance < bestDistance) {
      best = candidate;
      bestDistance = candidateDistance;
    }
  }
  return best;
}

} // namespace offstage
