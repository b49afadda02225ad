#include "src/scene/expression.h"

#include "src/scene/limits.h"
#include "src/scene/quote.h"
#include "src/sim/strict_math.h"

#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <muParser.h>

namespace offstage {
namespace {

double truth(bool value) {
  return value ? 1.0 : 0.0;
}

void defineFunctions(mu::Parser& parser) {
  using One = double (*)(double);
  using Two = double (*)(double, double);
  const auto one = [&parser](const char* name, One function) { parser.DefineFun(name, function); };
  const auto two = [&parser](const char* name, Two function) { parser.DefineFun(name, function); };
  one("sin", strict::sin);
  one("cos", strict::cos);
  one("tan", strict::tan);
  one("asin", strict::asin);
  one("acos", strict::acos);
  one("atan", strict::atan);
  two("atan2", strict::atan2);
  one("sinh", strict::sinh);
  one("cosh", strict::cosh);
  one("tanh", strict::tanh);
  one("exp", strict::exp);
  one("ln", strict::log);
  one("log", strict::log);
  one("log10", strict::log10);
  one("log2", strict::log2);
  two("pow", strict::pow);
  one("sqrt", strict::sqrt);
  // Exact in IEEE 754, so that any library gives the same.
  one("abs", [](double a) { return std::fabs(a); });
  one("floor", [](double a) { return std::floor(a); });
  one("ceil", [](double a) { return std::ceil(a); });
  one("sign", [](double a) { return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : a; });
  two("min", [](double a, double b) { return b < a ? b : a; });
  two("max", [](double a, double b) { return a < b ? b : a; });
}

void defineOperators(mu::Parser& parser) {
  using Two = double (*)(double, double);
  const auto define = [&parser](const char* name, Two function, unsigned priority,
                                mu::EOprtAssociativity associativity = mu::oaLEFT) {
    parser.DefineOprt(name, function, priority, associativity, true);
  };
  define(
      "||", [](double a, double b) { return truth(a != 0.0 || b != 0.0); }, mu::prLOR);
  define(
      "&&", [](double a, double b) { return truth(a != 0.0 && b != 0.0); }, mu::prLAND);
  define(
      "<", [](double a, double b) { return truth(a < b); }, mu::prCMP);
  define(
      "<=", [](double a, double b) { return truth(a <= b); }, mu::prCMP);
  define(
      ">", [](double a, double b) { return truth(a > b); }, mu::prCMP);
  define(
      ">=", [](double a, double b) { return truth(a >= b); }, mu::prCMP);
  define(
      "==", [](double a, double b) { return truth(a == b); }, mu::prCMP);
  define(
      "!=", [](double a, double b) { return truth(a != b); }, mu::prCMP);
  define(
      "+", [](double a, double b) { return a + b; }, mu::prADD_SUB);
  define(
      "-", [](double a, double b) { return a - b; }, mu::prADD_SUB);
  define(
      "*", [](double a, double b) { return a * b; }, mu::prMUL_DIV);
  define(
      "/", [](double a, double b) { return a / b; }, mu::prMUL_DIV);
  define("^", strict::pow, mu::prPOW, mu::oaRIGHT);
  parser.DefineInfixOprt("-", [](double a) { return -a; });
  parser.DefineInfixOprt("+", [](double a) { return a; });
}

bool isFunction(const std::string& name) {
  mu::Parser parser;
  parser.ClearFun();
  defineFunctions(parser);
  return parser.GetFunDef().contains(name);
}

/// muParser's own messages name positions from 0 and types of its own; these say it in the user's words.
std::string problemOf(const mu::ParserError& error) {
  std::string rest = error.GetToken(); // may be all that follows, with a blank that muParser appends
  while (!rest.empty() && rest.back() == ' ') rest.pop_back();
  const std::string token = quotedText(rest);
  switch (error.GetCode()) {
  case mu::ecUNASSIGNABLE_TOKEN:
    if (isFunction(rest)) return fmt::format("{} is a function and needs a '(' behind it", token);
    return fmt::format("{} is no variable, function or number", token);
  case mu::ecUNEXPECTED_EOF:
    return "it ends too early";
  case mu::ecEMPTY_EXPRESSION:
    return "it is empty";
  case mu::ecMISSING_PARENS:
    return "a parenthesis is not closed";
  case mu::ecTOO_MANY_PARAMS:
    return fmt::format("too many arguments for {}", token);
  case mu::ecTOO_FEW_PARAMS:
    return fmt::format("too few arguments for {}", token);
  case mu::ecMISSING_ELSE_CLAUSE:
    return "a '?' lacks its ':'";
  case mu::ecMISPLACED_COLON:
    return "a ':' lacks its '?'";
  case mu::ecUNEXPECTED_STR:
  case mu::ecSTR_RESULT:
  case mu::ecUNTERMINATED_STRING:
    return "it holds a quotation mark";
  case mu::ecIDENTIFIER_TOO_LONG:
    return "a name is too long";
  default:
    return rest.empty() ? "it is not well formed" : fmt::format("{} does not fit here", token);
  }
}

/// Blanks of every kind become spaces, so that an expression may be written over several lines; muParser is
/// not given any other control character or byte beyond ASCII.
std::string cleaned(const std::string& text) {
  if (text.size() > kMaxExpressionLength) {
    throw ExpressionError(fmt::format("it may have at most {} characters", kMaxExpressionLength), 0);
  }
  std::string clean = text;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    if (clean[i] == '\n' || clean[i] == '\r' || clean[i] == '\t') clean[i] = ' ';
    if (clean[i] < ' ' || clean[i] > '~') throw ExpressionError("only ASCII characters are allowed", i + 1);
  }
  return clean;
}

} // namespace

struct Expression::Compiled {
  explicit Compiled(std::string source) : text(std::move(source)) {
    parser.ClearFun();
    parser.ClearConst();
    parser.ClearOprt();
    parser.ClearInfixOprt();
    parser.EnableBuiltInOprt(false);
    defineFunctions(parser);
    defineOperators(parser);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    parser.DefineVar("x", &variables.x);
    parser.DefineVar("y", &variables.y);
    parser.DefineVar("vx", &variables.vx);
    parser.DefineVar("vy", &variables.vy);
    parser.DefineVar("t", &variables.t);
    parser.DefineVar("m", &variables.m);
    parser.SetExpr(text);
    // The first evaluation compiles; after it the bytecode runs, which cannot fail.
    static_cast<void>(parser.Eval());
    if (parser.GetNumResults() != 1) throw ExpressionError("it holds a ',' outside of a function", 0);
  }

  std::string text;
  ExpressionVariables variables;
  mu::Parser parser;
};

Expression::Expression(const std::string& text) {
  const std::string clean = cleaned(text);
  try {
    compiled_ = std::make_unique<Compiled>(clean);
  } catch (const mu::ParserError& error) {
    const int position = error.GetPos();
    throw ExpressionError(problemOf(error),
                          position >= 0 && static_cast<std::size_t>(position) <= clean.size()
                              ? static_cast<std::size_t>(position) + 1
                              : 0);
  }
}

// muParser's bytecode holds addresses of the variables, so a copy compiles the text anew.
Expression::Expression(const Expression& other)
    : compiled_(std::make_unique<Compiled>(other.compiled_->text)) {}

Expression& Expression::operator=(const Expression& other) {
  if (this != &other) compiled_ = std::make_unique<Compiled>(other.compiled_->text);
  return *this;
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

double Expression::operator()(const ExpressionVariables& variables) const {
  compiled_->variables = variables;
  return compiled_->parser.Eval();
}

} // namespace offstage
