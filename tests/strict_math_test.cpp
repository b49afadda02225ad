#include "src/sim/strict_math.h"
#include "tests/support/oracle_case.h"
#include "tests/support/reference_csv.h"

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using Unary = double (*)(double);

const std::map<std::string, Unary>& unaryFunctions() {
  static const std::map<std::string, Unary> kFunctions{
      {"sin", strict::sin},   {"cos", strict::cos},     {"tan", strict::tan},   {"asin", strict::asin},
      {"acos", strict::acos}, {"atan", strict::atan},   {"exp", strict::exp},   {"expm1", strict::expm1},
      {"log", strict::log},   {"log10", strict::log10}, {"sinh", strict::sinh}, {"cosh", strict::cosh},
      {"tanh", strict::tanh}};
  return kFunctions;
}

TEST(StrictMath, EqualsJavasStrictMathBitForBit) {
  const ReferenceCsv reference(referenceFolder() / "more/strict_math.csv.gz");
  std::map<std::string, int> compared;
  for (std::size_t row = 0; row < reference.rows(); ++row) {
    const std::string& function = reference.cell(row, "function");
    const double x = reference.hex(row, "x_hex");
    const double y = reference.hex(row, "y_hex");
    const double expected = reference.hex(row, "result_hex");
    double result = 0.0;
    if (function == "pow") {
      result = strict::pow(x, y);
    } else if (function == "atan2") {
      result = strict::atan2(x, y);
    } else {
      result = unaryFunctions().at(function)(x);
    }
    EXPECT_TRUE(sameBits(result, expected)) << function << '(' << show(x) << ", " << show(y)
                                            << ") = " << show(result) << " instead of " << show(expected);
    ++compared[function];
  }
  EXPECT_EQ(compared.size(), 15U);
  for (const auto& [function, count] : compared) EXPECT_GE(count, 150) << function;
}

TEST(StrictMath, IsWithinAnUlpOfTheLibraryOverAWideRange) {
  // The C library of this machine, to which no bit is promised, catches what two equal mistakes would hide.
  for (int i = -2000; i <= 2000; ++i) {
    const double x = i * 0.37;
    const double ulp = std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(strict::sin(x), std::sin(x), ulp) << "x = " << x;
    EXPECT_NEAR(strict::cos(x), std::cos(x), ulp) << "x = " << x;
    EXPECT_NEAR(strict::exp(x / 10) / std::exp(x / 10), 1.0, 2 * ulp) << "x = " << x / 10;
    if (x > 0) {
      EXPECT_NEAR(strict::log2(x), std::log2(x), 4 * ulp * std::abs(std::log2(x)) + ulp) << "x = " << x;
    }
  }
}

TEST(StrictMath, Log2IsExactForPowersOfTwo) {
  for (int n = -1074; n < 1024; ++n) EXPECT_EQ(strict::log2(std::ldexp(1.0, n)), n);
  EXPECT_EQ(strict::log2(0.0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(strict::log2(std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(strict::log2(-1.0)));
}

} // namespace
} // namespace offstage::test
