#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace offstage {

/// What is wrong with a number format; what() fits behind "is no number format: ".
class NumberFormatError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// How a live value is written: fmt's [[fill]align][sign][0][width][.precision][type], type e, f, g, E, F, G,
/// or d for the nearest whole number; align <, ^ or >; sign +, - or a blank. Without a type and a precision:
/// the shortest digits that read back to the same bits. Decimal point whatever the locale.
class NumberFormat {
public:
  NumberFormat() = default;
  /// Throws NumberFormatError.
  explicit NumberFormat(std::string_view spec);

  /// What rounds to zero has no minus. No number at all is a dash, infinity "inf".
  [[nodiscard]] std::string text(double value) const;

private:
  std::string format_ = "{}"; ///< for fmt
  int width_ = 0;
  bool whole_ = false;
};

} // namespace offstage
