#pragma once

#include <cmath>

/// Elementary functions with the same bits on every machine. The C library's differ in the last place from
/// one version and processor to the next; these use nothing but IEEE 754 basic operations (and integers) in a
/// fixed order, and give exactly what Java's StrictMath gives, whose specification demands the results of
/// fdlibm. (The exceptions, which StrictMath does not have, are named below.)
///
/// Source of every algorithm and coefficient: fdlibm, the "Freely Distributable LIBM" of K. C. Ng and others
/// (Sun Microsystems, 1993; netlib.org/fdlibm); errors are below 1 ulp. Any argument is allowed: out of a
/// function's domain the result is NaN, NaN goes in and out, infinities and signed zeros are treated as in
/// C's Annex F. Angles are in radians.
namespace offstage::strict {

double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x); ///< angle of the point (x, y), −π … π

double exp(double x);
double expm1(double x); ///< exp(x) − 1 without cancellation near 0
double log(double x);
double log10(double x);
double log2(double x); ///< not in StrictMath: exact for powers of two, else log(x)/ln 2, below 2 ulp
double pow(double x, double y);
double sinh(double x);
double cosh(double x);
double tanh(double x);

/// IEEE 754 requires the square root to be correctly rounded, so the library's is the same everywhere.
inline double sqrt(double x) {
  return std::sqrt(x);
}

} // namespace offstage::strict
