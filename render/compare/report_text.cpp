#include "render/compare/report.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

std::string valueText(const ReportNumber& number) {
  struct Text {
    std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
    std::string operator()(double value) const {
      return std::isfinite(value) ? fmt::format("{:.6g}", value) : "infinite";
    }
    std::string operator()(const std::string& value) const { return value; }
    std::string operator()(bool value) const { return value ? "yes" : "no"; }
    std::string operator()(const std::vector<std::int64_t>& values) const {
      std::string text;
      for (const std::int64_t value : values) text += fmt::format("{}{}", text.empty() ? "" : ", ", value);
      return text;
    }
  };
  const std::string text = std::visit(Text{}, number.value);
  return number.unit.empty() ? text : text + " " + number.unit;
}

void writeNumbers(std::ostream& out, const std::vector<ReportNumber>& numbers) {
  std::size_t widest = 0;
  for (const ReportNumber& number : numbers) widest = std::max(widest, number.label.size());
  for (const ReportNumber& number : numbers)
    if (!number.label.empty()) out << fmt::format("  {:<{}}  {}\n", number.label, widest, valueText(number));
}

/// "(255, 255, 255)", alpha only where it is not 255 in both.
std::string colorText(const PixelPair& pixel, const std::array<double, 4>& color) {
  const bool alpha = pixel.expected[3] < 255.0 || pixel.actual[3] < 255.0;
  std::string text = fmt::format("({:.5g}, {:.5g}, {:.5g}", color[0], color[1], color[2]);
  if (alpha) text += fmt::format(", {:.5g}", color[3]);
  return text + ")";
}

void writeWorst(std::ostream& out, const std::vector<PixelPair>& worst) {
  if (worst.empty()) return;
  out << "  worst pixels (x, y: expected, actual)\n";
  for (const PixelPair& pixel : worst)
    out << fmt::format("    {}, {}: {}, {}\n", pixel.x, pixel.y, colorText(pixel, pixel.expected),
                       colorText(pixel, pixel.actual));
}

/// The run's tolerance, and those of cases that were held to another: also of cases that pass, which are not
/// listed.
void writeTolerances(std::ostream& out, const Report& report) {
  out << "  tolerance: " << report.tolerance << '\n';
  std::map<std::string, std::size_t> others;
  for (const ReportCase& one : report.cases)
    if (!one.tolerance.empty() && one.tolerance != report.tolerance) ++others[one.tolerance];
  for (const auto& [tolerance, count] : others)
    out << fmt::format("  tolerance of {} of {}: {}\n", count, report.cases.size(), tolerance);
}

} // namespace

void writeText(std::ostream& out, const Report& report) {
  // A single pair is the whole; of more, those that pass are only counted.
  const bool single = report.cases.size() == 1 && report.numbers.empty();
  out << report.verdict << '\n';
  writeTolerances(out, report);
  for (const std::string& line : report.lines) out << "  " << line << '\n';
  writeNumbers(out, report.numbers);
  for (const ReportCase& one : report.cases) {
    if (!single) {
      if (one.passed && one.lines.empty()) continue;
      out << one.name << ": " << one.verdict << '\n';
    }
    for (const std::string& line : one.lines) out << "  " << line << '\n';
    if (!single) continue;
    writeNumbers(out, one.numbers);
    writeWorst(out, one.worst);
  }
}

} // namespace offstage
