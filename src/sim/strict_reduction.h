#pragma once

namespace offstage::strict {

/// An angle as quadrant·π/2 + (high + low), |high + low| ≤ π/4 (about), with low below half an ulp of high.
struct ReducedAngle {
  int quadrant; ///< modulo 4 it is the quadrant; the sign may be any
  double high;
  double low;
};

/// Reduces any finite |x| > π/4, with all of the bits of π that it takes.
ReducedAngle reduceAngle(double x);

} // namespace offstage::strict
