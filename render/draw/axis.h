#pragma once

#include <string>
#include <vector>

namespace offstage {

/// The scale of one axis of a plot: from values to 0 … 1.
class Axis {
public:
  /// `low` < `high`, finite; of a logarithmic axis both > 0.
  Axis(double low, double high, bool log);

  /// 0 at low, 1 at high, beyond them outside. NaN for what a logarithmic axis does not have.
  [[nodiscard]] double place(double value) const;

  struct Tick {
    double value;
    std::string label;
  };
  /// Ticks at 1, 2 or 5 times powers of ten (of a logarithmic axis at powers of ten, or at 1, 2 and 5 times
  /// them where there are few), at most `most` (≥ 2) but for rounding.
  [[nodiscard]] std::vector<Tick> ticks(int most) const;

  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// The axis for values between `least` and `greatest`: up to the next ticks of about `most`; a little room
  /// where they are equal. Not finite: 0 … 1, or 1 … 10.
  static Axis around(double least, double greatest, bool log, int most);

private:
  double low_;
  double high_;
  bool log_;
};

/// A number as a tick shows it: as many digits as `step` (> 0) needs, so that no two neighbours look alike,
/// and "−" for minus. Powers of ten from a million and below a ten-thousandth on, unless so many digits stand
/// before them that the plain number is no longer. `greatest`: the largest size of all numbers that shall
/// look alike; 0: each for itself.
std::string tickLabel(double value, double step, double greatest = 0.0);

} // namespace offstage
