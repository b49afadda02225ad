#pragma once

#include <limits>
#include <string>

namespace offstage {

/// The finite numbers that a key may hold.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool lowIncluded = true;

  static Range any() { return {}; }
  static Range atLeast(double low) { return {low, std::numeric_limits<double>::infinity(), true}; }
  static Range above(double low) { return {low, std::numeric_limits<double>::infinity(), false}; }
  static Range between(double low, double high) { return {low, high, true}; }
  static Range aboveUpTo(double low, double high) { return {low, high, false}; }

  [[nodiscard]] bool contains(double value) const {
    return (lowIncluded ? value >= low : value > low) && value <= high;
  }
  /// For messages, behind "must be": "at least 0", "greater than 0", "from 0 to 1".
  [[nodiscard]] std::string text() const;
};

} // namespace offstage
