#include "render/compare/report_json.h"

#include "render/compare/report.h"
#include "render/output/json_text.h"

#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

std::string list(const std::vector<std::string>& items) {
  std::string text = "[";
  for (const std::string& item : items) text += (text.size() > 1 ? ", " : "") + item;
  return text + "]";
}

std::string numbersJson(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + jsonNumber(value);
  return text + "]";
}

struct ValueJson {
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return jsonNumber(value); }
  std::string operator()(const std::string& value) const { return jsonText(value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(const std::vector<std::int64_t>& values) const {
    std::string text = "[";
    for (const std::int64_t value : values) text += fmt::format("{}{}", text.size() > 1 ? ", " : "", value);
    return text + "]";
  }
};

std::string pixelJson(const PixelPair& pixel) {
  return fmt::format(R"({{"x": {}, "y": {}, "expected": {}, "actual": {}, "difference": {}}})", pixel.x,
                     pixel.y, numbersJson({pixel.expected.begin(), pixel.expected.end()}),
                     numbersJson({pixel.actual.begin(), pixel.actual.end()}), jsonNumber(pixel.difference));
}

} // namespace

std::string jsonNumber(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string jsonLines(const std::vector<std::string>& lines) {
  std::vector<std::string> items;
  items.reserve(lines.size());
  for (const std::string& line : lines) items.push_back(jsonText(line));
  return list(items);
}

std::string jsonValue(const ReportNumber& number) {
  return std::visit(ValueJson{}, number.value);
}

std::string jsonMembers(const std::vector<ReportNumber>& numbers) {
  std::string text;
  for (const ReportNumber& number : numbers)
    text += fmt::format(", {}: {}", jsonText(number.key), jsonValue(number));
  return text;
}

std::string jsonCurves(const std::vector<ReportCurve>& curves) {
  std::vector<std::string> items;
  items.reserve(curves.size());
  for (const ReportCurve& curve : curves)
    items.push_back(fmt::format(R"({{"key": {}, "name": {}, "unit": {}, "times": {}, "values": {}}})",
                                jsonText(curve.key), jsonText(curve.name), jsonText(curve.unit),
                                numbersJson(curve.times), numbersJson(curve.values)));
  return list(items);
}

std::string jsonWorst(const std::vector<PixelPair>& worst) {
  std::vector<std::string> items;
  items.reserve(worst.size());
  for (const PixelPair& pixel : worst) items.push_back(pixelJson(pixel));
  return list(items);
}

void writeJson(std::ostream& out, const Report& report) {
  out << fmt::format(R"({{"title": {}, "passed": {}, "verdict": {}, "tolerance": {}, "lines": {}{})",
                     jsonText(report.title), report.passed, jsonText(report.verdict),
                     jsonText(report.tolerance), jsonLines(report.lines), jsonMembers(report.numbers));
  if (!report.curves.empty()) out << ", \"curves\": " << jsonCurves(report.curves);
  out << ", \"cases\": [";
  const char* separator = "\n  ";
  for (const ReportCase& one : report.cases) {
    out << separator
        << fmt::format(
               R"({{"name": {}, "passed": {}, "verdict": {}, "severity": {}, "seconds": {}, "lines": {}{})",
               jsonText(one.name), one.passed, jsonText(one.verdict), jsonNumber(one.severity),
               jsonNumber(one.seconds), jsonLines(one.lines), jsonMembers(one.numbers));
    if (!one.tolerance.empty()) out << ", \"tolerance\": " << jsonText(one.tolerance);
    if (!one.worst.empty()) out << ", \"worst_pixels\": " << jsonWorst(one.worst);
    if (!one.curves.empty()) out << ", \"curves\": " << jsonCurves(one.curves);
    if (!one.acceptCommand.empty()) out << ", \"accept\": " << jsonText(one.acceptCommand);
    out << '}';
    separator = ",\n  ";
  }
  out << (report.cases.empty() ? "]}\n" : "\n]}\n");
}

} // namespace offstage
