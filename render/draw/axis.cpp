#include "render/draw/axis.h"

#include "src/scene/overlay.h"
#include "src/sim/strict_math.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Behind the point of a number before a power of ten, that stands there however long the plain number is.
constexpr int kFewDigits = 2;
constexpr int kPowerLength = 4; ///< letters of "·10⁶"

/// 10^exponent, exactly where a double can hold it.
double powerOfTen(int exponent) {
  return exponent >= 0 ? strict::pow(10.0, exponent) : 1.0 / strict::pow(10.0, -exponent);
}

std::string raised(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

std::string withMinus(std::string text) {
  if (text.starts_with('-')) text = "−" + text.substr(1);
  return text == "−0" ? "0" : text;
}

int floorOfLog(double value) {
  return static_cast<int>(std::floor(strict::log10(value) + 1e-9));
}

int ceilingOfLog(double value) {
  return static_cast<int>(std::ceil(strict::log10(value) - 1e-9));
}

} // namespace

Axis::Axis(double low, double high, bool log) : low_(low), high_(high), log_(log) {}

double Axis::place(double value) const {
  if (!log_) return (value - low_) / (high_ - low_);
  if (!(value > 0.0)) return std::nan("");
  return strict::log(value / low_) / strict::log(high_ / low_);
}

std::vector<Axis::Tick> Axis::ticks(int most) const {
  std::vector<Tick> ticks;
  if (!log_) {
    double step = roundStep((high_ - low_) / most);
    double first = 0.0;
    double count = 0.0; // of steps from the first tick to the last
    const auto place = [&] {
      first = std::ceil(low_ / step - 1e-9);
      count = std::floor(high_ / step + 1e-9) - first;
    };
    place();
    if (count < 1.0) { // a single tick tells no scale
      step = roundStep(0.3 * step);
      place();
    }
    // Counted from 0, for where doubles have no fraction left adding 1 may change nothing.
    const double last = first + std::min(std::floor(count), static_cast<double>(most));
    const double greatest = std::max(std::abs(first), std::abs(last)) * step;
    for (int i = 0; first + i <= last && i <= most; ++i)
      ticks.push_back({(first + i) * step, tickLabel((first + i) * step, step, greatest)});
    return ticks;
  }
  const int first = ceilingOfLog(low_);
  const int last = floorOfLog(high_);
  const int decades = last - first + 1;
  const int stride = std::max((decades + most - 1) / most, 1);
  for (int exponent = first - 1; exponent <= last; ++exponent) {
    const double power = powerOfTen(exponent);
    if (stride > 1 && ((exponent % stride) + stride) % stride != 0) continue;
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * power;
      const bool inside = value >= low_ * (1.0 - 1e-9) && value <= high_ * (1.0 + 1e-9);
      if (!inside || (factor > 1.0 && 3 * decades > most)) continue;
      const bool small = exponent >= -2 && exponent <= 3;
      ticks.push_back({value, small           ? tickLabel(value, power)
                              : factor == 1.0 ? "10" + raised(exponent)
                                              : fmt::format("{}·10{}", factor, raised(exponent))});
    }
  }
  return ticks;
}

Axis Axis::around(double least, double greatest, bool log, int most) {
  const bool usable = std::isfinite(least) && std::isfinite(greatest) && least <= greatest;
  if (log) {
    if (!usable || !(least > 0.0)) return {1.0, 10.0, true};
    const double low = powerOfTen(floorOfLog(least));
    const double high = powerOfTen(ceilingOfLog(greatest));
    return {low, high > low ? high : 10.0 * low, true};
  }
  if (!usable) return {0.0, 1.0, false};
  const bool alike = greatest - least <= 1e-12 * std::max(std::abs(least), std::abs(greatest));
  const double room = alike ? std::max(std::abs(least), 1.0) * 0.5 : 0.0;
  const double step = roundStep((greatest - least + 2.0 * room) / most);
  return {std::floor((least - room) / step + 1e-9) * step, std::ceil((greatest + room) / step - 1e-9) * step,
          false};
}

std::string tickLabel(double value, double step, double greatest) {
  const double size = std::max({std::abs(value), greatest, step});
  const int stepExponent = floorOfLog(step);
  const int decimals = std::max(-stepExponent, 0);
  const bool extreme = size >= 1e6 || step < 1e-4;
  // What a factor before a power of ten would need. Of many digits only few would be spared.
  const int digits = floorOfLog(size) - stepExponent;
  const int plainLength = std::max(floorOfLog(size), 0) + 1 + (decimals > 0 ? decimals + 1 : 0);
  const int powerLength = digits + 2 + kPowerLength;
  if (!extreme || (digits > kFewDigits && plainLength <= powerLength))
    return withMinus(fmt::format("{:.{}f}", value, decimals));
  if (value == 0.0) return "0";
  const int exponent = floorOfLog(std::abs(value));
  const double factor = value / powerOfTen(exponent);
  const std::string text = digits > kFewDigits
                               ? fmt::format("{:.{}f}", factor, std::max(exponent - stepExponent, 0))
                               : fmt::format("{:.{}g}", factor, kFewDigits + 1);
  return withMinus(text) + "·10" + raised(exponent);
}

} // namespace offstage
