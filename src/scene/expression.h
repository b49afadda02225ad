#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

namespace offstage {

/// What is wrong with an expression, and at which of its characters (from 1; 0: the expression as a whole).
class ExpressionError : public std::runtime_error {
public:
  ExpressionError(const std::string& problem, std::size_t character)
      : std::runtime_error(problem), character_(character) {}
  [[nodiscard]] std::size_t character() const noexcept { return character_; }

private:
  std::size_t character_;
};

/// What an expression may depend on.
struct ExpressionVariables {
  double x = 0.0, y = 0.0;   ///< position
  double vx = 0.0, vy = 0.0; ///< velocity
  double t = 0.0;            ///< s
  double m = 1.0;            ///< mass
};

/// A formula in x, y, vx, vy, t and m, read by muParser: numbers; pi, e; + - * / ^ (right to left), unary +
/// -; < <= > >= == != && || (1 or 0); a ? b : c; sin cos tan asin acos atan (radians) atan2(y, x) sinh cosh
/// tanh exp ln log (= ln) log10 log2 sqrt abs sign floor ceil min(a, b) max(a, b) pow(a, b).
///
/// muParser's own functions and its ^ call the C library, whose last bits differ from machine to machine, so
/// every one of them is replaced by src/sim/strict_math.h. Its assignment operator is left out: an expression
/// has no memory. A copy shares nothing with its original, so that copied worlds can run in parallel.
class Expression {
public:
  /// Throws ExpressionError when `text` is no such formula or longer than kMaxExpressionLength characters.
  explicit Expression(const std::string& text);
  ~Expression();
  Expression(const Expression& other);
  Expression& operator=(const Expression& other);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  /// Any double, NaN and infinities included; never throws.
  [[nodiscard]] double operator()(const ExpressionVariables& variables) const;

private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

} // namespace offstage
