#include "src/scene/expression.h"
#include "src/scene/limits.h"
#include "src/sim/strict_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

double eval(const std::string& text, const ExpressionVariables& variables = {}) {
  return Expression(text)(variables);
}

std::string errorOf(const std::string& text) {
  try {
    const Expression expression(text);
    return "no error";
  } catch (const ExpressionError& error) {
    return fmt::format("{}: {}", error.character(), error.what());
  }
}

TEST(Expression, KnowsItsVariables) {
  const ExpressionVariables variables{2.0, 3.0, 5.0, 7.0, 11.0, 13.0};
  EXPECT_EQ(eval("x + 10*y + 100*vx + 1000*vy + 10000*t + 100000*m", variables), 1417532.0);
}

TEST(Expression, OperatorsBindAsInMathematics) {
  EXPECT_EQ(eval("2 + 3*4"), 14.0);
  EXPECT_EQ(eval("2 - 3 - 4"), -5.0);
  EXPECT_EQ(eval("8/4/2"), 1.0);
  EXPECT_EQ(eval("2^3^2"), 512.0);
  EXPECT_EQ(eval("-3^2"), -9.0);
  EXPECT_EQ(eval("2*-3"), -6.0);
  EXPECT_EQ(eval("2^-1"), 0.5);
  EXPECT_EQ(eval("-(-2)"), 2.0);
  EXPECT_EQ(eval("(2 + 3)*4"), 20.0);
  EXPECT_EQ(eval("1 < 2 && 2 <= 2 && 3 > 2 && 3 >= 3 && 1 == 1 && 1 != 2"), 1.0);
  EXPECT_EQ(eval("1 > 2 || 2 > 3"), 0.0);
  EXPECT_EQ(eval("x > 0 ? 5 : 7"), 7.0);
  EXPECT_EQ(eval("0 ? 1 : 0 ? 2 : 3"), 3.0);
  EXPECT_EQ(eval(" 1\n+\t2 "), 3.0);
}

TEST(Expression, FunctionsAreThoseOfStrictMathToTheBit) {
  const std::pair<const char*, double (*)(double)> functions[] = {
      {"sin", strict::sin},   {"cos", strict::cos},   {"tan", strict::tan},     {"asin", strict::asin},
      {"acos", strict::acos}, {"atan", strict::atan}, {"sinh", strict::sinh},   {"cosh", strict::cosh},
      {"tanh", strict::tanh}, {"exp", strict::exp},   {"ln", strict::log},      {"log", strict::log},
      {"log2", strict::log2}, {"sqrt", strict::sqrt}, {"log10", strict::log10},
  };
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> distribution(0.0, 1.0);
  for (const auto& [name, function] : functions) {
    const Expression expression(fmt::format("{}(x)", name));
    for (int i = 0; i < 1000; ++i) {
      const double x = distribution(random);
      const double value = expression({x, 0.0, 0.0, 0.0, 0.0, 1.0});
      ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(function(x)))
          << name << "(" << x << ") = " << value << ", wanted " << function(x);
    }
  }
}

TEST(Expression, PowersAreStrictWhetherConstantOrNot) {
  // Constants are folded when the expression is compiled: that must not go through the C library either.
  for (const double base : {0.1, 1.7, 3.0, 1234.5}) {
    for (const double exponent : {2.0, 3.0, 4.0, 0.3, -1.7}) {
      const double wanted = strict::pow(base, exponent);
      const ExpressionVariables variables{base, exponent, 0.0, 0.0, 0.0, 1.0};
      EXPECT_EQ(eval("x^y", variables), wanted) << base << "^" << exponent;
      EXPECT_EQ(eval("pow(x, y)", variables), wanted) << base << "^" << exponent;
      EXPECT_EQ(eval(fmt::format("{}^({})", base, exponent)), wanted) << base << "^" << exponent;
      EXPECT_EQ(eval(fmt::format("x^({})", exponent), variables), wanted) << base << "^" << exponent;
    }
  }
  EXPECT_EQ(eval("sin(0.3)"), strict::sin(0.3));
  EXPECT_EQ(eval("atan2(1, -2)"), strict::atan2(1.0, -2.0));
}

TEST(Expression, ExactFunctions) {
  EXPECT_EQ(eval("abs(-2) + floor(-1.5) + ceil(1.5) + sign(-3)"), 1.0);
  EXPECT_EQ(eval("min(2, 3) + 10*max(2, 3)"), 32.0);
  EXPECT_EQ(eval("pi"), 3.141592653589793);
  EXPECT_EQ(eval("e"), 2.718281828459045);
}

TEST(Expression, WhatIsNoNumberFlowsOn) {
  EXPECT_TRUE(std::isnan(eval("0/x")));
  EXPECT_TRUE(std::isnan(eval("sqrt(-1) + 1")));
  EXPECT_TRUE(std::isnan(eval("x", {std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 1})));
  EXPECT_EQ(eval("1/x"), std::numeric_limits<double>::infinity());
}

TEST(Expression, ErrorsNameThePlace) {
  EXPECT_EQ(errorOf("sin(x) + zz"), "10: \"zz\" is no variable, function or number");
  EXPECT_EQ(errorOf("2 +"), "0: it ends too early");
  EXPECT_EQ(errorOf("  "), "0: it is empty");
  EXPECT_EQ(errorOf("(1 + 2"), "0: a parenthesis is not closed");
  EXPECT_EQ(errorOf("sin(1, 2)"), "9: too many arguments for \"sin\"");
  EXPECT_EQ(errorOf("x > 1 ? min(x) : 2"), "14: too few arguments for \"min\"");
  EXPECT_EQ(errorOf("x ? 1"), "0: a '?' lacks its ':'");
  EXPECT_EQ(errorOf("x y"), "3: \"y\" does not fit here");
  EXPECT_EQ(errorOf("1, 2"), "0: it holds a ',' outside of a function");
  EXPECT_EQ(errorOf("x\xc2\xb2"), "2: only ASCII characters are allowed");
  EXPECT_EQ(errorOf(std::string("1\0", 2)), "2: only ASCII characters are allowed");
  EXPECT_EQ(errorOf("sin"), "1: \"sin\" is a function and needs a '(' behind it");
  EXPECT_EQ(errorOf("x + max * 2"), "5: \"max\" is a function and needs a '(' behind it");
  EXPECT_EQ(errorOf("sinx"), "1: \"sinx\" is no variable, function or number");
  EXPECT_EQ(errorOf("1e999"), "1: \"1e999\" is no variable, function or number");
}

TEST(Expression, HasNoAssignmentAndNoneOfTheLibrarysOwnNames) {
  EXPECT_NE(errorOf("x = 3"), "no error");
  for (const char* name : {"rnd", "sum(1, 2)", "avg(1, 2)", "rint(1)", "cot(1)", "_pi", "_e"}) {
    EXPECT_NE(errorOf(name), "no error") << name;
  }
}

TEST(Expression, LengthIsLimited) {
  EXPECT_EQ(eval("1" + std::string(kMaxExpressionLength - 1, ' ')), 1.0);
  EXPECT_EQ(errorOf(std::string(kMaxExpressionLength + 1, '1')), "0: it may have at most 4096 characters");
}

TEST(Expression, DeepAndLongExpressionsNeitherCrashNorHang) {
  const std::string open(2000, '(');
  const std::string close(2000, ')');
  EXPECT_EQ(eval(open + "1" + close), 1.0);
  EXPECT_NE(errorOf(open + open), "no error");
  EXPECT_NE(errorOf(std::string(4000, '-') + "1"), "no error"); // one sign a number
  std::string tower = "1";
  while (tower.size() < 4000) tower.insert(0, "1^");
  EXPECT_EQ(eval(tower), 1.0);
  std::string choices = "0";
  while (choices.size() < 4000) choices.insert(0, "x?1:");
  EXPECT_EQ(eval(choices), 0.0);
  std::string nested = "x";
  while (nested.size() < 4000) nested.insert(0, "max(1,").append(")");
  EXPECT_EQ(eval(nested), 1.0);
}

TEST(Expression, RandomTextNeverCrashes) {
  const char* const words[] = {
      "x", "vy", "1", "2.5e-3", "sin(", "max(", "(",  ")", ",", "+",  "-", "*",  "/", "^",
      "?", ":",  "<", ">=",     "==",   "&&",   "||", "=", " ", "\"", "e", "pi", "!"};
  std::mt19937 random(7);
  int valid = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (auto length = random() % 12 + 1; length > 0; --length) text += words[random() % std::size(words)];
    try {
      const Expression expression(text);
      const double value = expression({1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
      const double again = Expression(expression)({1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
      ++valid;
      ASSERT_TRUE(value == again || (std::isnan(value) && std::isnan(again)))
          << text << ": " << value << ", " << again;
    } catch (const ExpressionError&) {
      continue; // refused, as most of these should be
    }
  }
  EXPECT_GT(valid, 100);
}

TEST(Expression, CopiesShareNothing) {
  std::function<double(double)> original = [expression = Expression("x*10")](double x) {
    return expression({x, 0.0, 0.0, 0.0, 0.0, 1.0});
  };
  auto copy = original;
  EXPECT_EQ(original(1.0), 10.0);
  original = nullptr;
  EXPECT_EQ(copy(2.0), 20.0);
  Expression a("1");
  const Expression b("2");
  a = b;
  EXPECT_EQ(a({}), 2.0);
}

} // namespace
} // namespace offstage
