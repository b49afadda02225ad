#include "src/scene/number_format.h"

#include "src/scene/quote.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace offstage {
namespace {

// No text is wider; without bounds a scene could ask for gigabytes of blanks.
constexpr int kMostWidth = 60;
constexpr int kMostPrecision = 20;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// The digits at `at`, which moves behind them; −1 without any.
int takeNumber(std::string_view spec, std::size_t& at, int most, std::string_view what) {
  if (at == spec.size() || !isDigit(spec[at])) return -1;
  int number = 0;
  for (; at < spec.size() && isDigit(spec[at]); ++at) {
    number = number * 10 + (spec[at] - '0');
    if (number > most) throw NumberFormatError(fmt::format("its {} is more than {}", what, most));
  }
  return number;
}

bool isAlign(char c) {
  return c == '<' || c == '>' || c == '^';
}

/// The minus of a number whose shown digits are all 0 says nothing.
bool isZero(std::string_view text) {
  const std::string_view mantissa = text.substr(0, text.find_first_of("eE"));
  return std::none_of(mantissa.begin(), mantissa.end(), [](char c) { return c >= '1' && c <= '9'; });
}

} // namespace

NumberFormat::NumberFormat(std::string_view spec) {
  std::size_t at = 0;
  if (spec.size() >= 2 && isAlign(spec[1])) {
    if (spec[0] < ' ' || spec[0] > '~' || spec[0] == '{' || spec[0] == '}')
      throw NumberFormatError("it may fill with an ASCII character only");
    at = 2;
  } else if (!spec.empty() && isAlign(spec[0])) {
    at = 1;
  }
  if (at < spec.size() && (spec[at] == '+' || spec[at] == '-' || spec[at] == ' ')) ++at;
  width_ = std::max(takeNumber(spec, at, kMostWidth, "width"), 0);
  int precision = -1;
  if (at < spec.size() && spec[at] == '.') {
    ++at;
    precision = takeNumber(spec, at, kMostPrecision, "precision");
    if (precision < 0) throw NumberFormatError("digits must follow its '.'");
  }
  const char type = at < spec.size() ? spec[at] : '\0';
  constexpr std::string_view kTypes = "efgEFGd";
  if (type != '\0' && (kTypes.find(type) == std::string_view::npos || at + 1 != spec.size()))
    throw NumberFormatError(fmt::format("{} does not fit there; allowed are [[fill]align][sign][0][width]"
                                        "[.precision][type], such as \".1f\", \"6.2f\" or \".3e\"",
                                        quotedText(spec.substr(at))));
  whole_ = type == 'd';
  if (whole_ && precision >= 0) throw NumberFormatError("a whole number ('d') has no precision");
  const std::string_view kept = whole_ ? spec.substr(0, at) : spec;
  format_ = fmt::format("{{:{}{}}}", kept, whole_ ? ".0f" : "");
}

std::string NumberFormat::text(double value) const {
  if (std::isnan(value)) {
    const int blanks = std::max(width_ - 1, 0);
    return std::string(static_cast<std::size_t>(blanks), ' ') + "–";
  }
  const double shown = whole_ ? std::round(value) : value;
  std::string text = fmt::format(fmt::runtime(format_), shown);
  if (std::signbit(shown) && std::isfinite(shown) && isZero(text))
    text = fmt::format(fmt::runtime(format_), 0.0);
  return text;
}

} // namespace offstage
