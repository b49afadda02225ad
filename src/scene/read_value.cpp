#include "src/scene/quote.h"
#include "src/scene/table_reader.h"

#include <cmath>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Integers up to here are doubles without loss.
constexpr std::int64_t kLargestExact = std::int64_t{1} << 53U;

} // namespace

std::string ValueName::text() const {
  if (array_ != nullptr) return fmt::format("value {} of {}", index_ + 1, array_->text());
  return table_ != nullptr ? table_->described(text_) : std::string(text_);
}

void reportMismatch(const TomlValue& value, const std::string& what, std::string_view wanted,
                    ErrorList& errors) {
  errors.add(value, fmt::format("{} must be {}, but it is {}", what, wanted, value.description()));
}

std::optional<double> readNumber(const TomlValue& value, const ValueName& what, Range range,
                                 ErrorList& errors) {
  double number = 0.0;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
    if (*integer > kLargestExact || *integer < -kLargestExact) {
      errors.add(value,
                 fmt::format("{} must be a number that a double holds exactly; beyond ±2^53 write it with a "
                             "decimal point, not as {}",
                             what.text(), *integer));
      return std::nullopt;
    }
    number = static_cast<double>(*integer);
  } else if (const auto* real = std::get_if<double>(&value.data)) {
    number = *real;
  } else {
    reportMismatch(value, what.text(), "a number", errors);
    return std::nullopt;
  }
  if (!std::isfinite(number)) {
    reportMismatch(value, what.text(), "a finite number", errors);
    return std::nullopt;
  }
  if (!range.contains(number)) {
    reportMismatch(value, what.text(), range.text(), errors);
    return std::nullopt;
  }
  return number;
}

std::optional<std::int64_t> readInteger(const TomlValue& value, const ValueName& what, std::int64_t low,
                                        std::int64_t high, ErrorList& errors) {
  const auto* integer = std::get_if<std::int64_t>(&value.data);
  if (integer == nullptr) {
    reportMismatch(value, what.text(), "an integer", errors);
    return std::nullopt;
  }
  if (*integer < low || *integer > high) {
    const bool bounded = high != std::numeric_limits<std::int64_t>::max();
    const std::string allowed =
        bounded ? fmt::format("from {} to {}", low, high) : fmt::format("at least {}", low);
    reportMismatch(value, what.text(), allowed, errors);
    return std::nullopt;
  }
  return *integer;
}

std::optional<Color> readColor(const TomlValue& value, const ValueName& what, ErrorList& errors) {
  constexpr std::string_view kWanted = "a colour (a CSS name, #rgb, #rgba, #rrggbb or #rrggbbaa)";
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) {
    reportMismatch(value, what.text(), kWanted, errors);
    return std::nullopt;
  }
  if (const auto color = parseColor(*text)) return color;
  const std::string_view near = nearestColorName(*text);
  const std::string hint = near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
  errors.add(value,
             fmt::format("{} must be {}, but it is {}{}", what.text(), kWanted, value.description(), hint));
  return std::nullopt;
}

bool readNumbers(const TomlValue& value, const ValueName& what, std::span<double> numbers, Range range,
                 ErrorList& errors) {
  const auto* array = value.array();
  if (array == nullptr || array->size() != numbers.size()) {
    reportMismatch(value, what.text(), fmt::format("an array of {} numbers", numbers.size()), errors);
    return false;
  }
  bool allRight = true;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = readNumber((*array)[i], ValueName(i, what), range, errors);
    if (number) {
      numbers[i] = *number;
    } else {
      allRight = false;
    }
  }
  return allRight;
}

} // namespace offstage
