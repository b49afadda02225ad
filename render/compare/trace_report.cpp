#include "render/compare/trace_report.h"

#include "src/scene/quote.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

void addDeviation(std::vector<ReportNumber>& numbers, const std::string& key, const std::string& label,
                  const TraceDeviation& deviation) {
  numbers.push_back({key + "_frame", label + ": frame", deviation.frame});
  numbers.push_back({key + "_time", label + ": time", deviation.time, "s"});
  numbers.push_back({key + "_body", label + ": body", deviation.body});
  numbers.push_back({key + "_quantity", label + ": quantity", std::string(name(deviation.quantity))});
  const std::string of(unit(deviation.quantity));
  numbers.push_back({key + "_expected", label + ": expected", deviation.expected, of});
  numbers.push_back({key + "_actual", label + ": actual", deviation.actual, of});
  numbers.push_back({key + "_error", label + ": error", deviation.error, of});
}

void addEvent(std::vector<ReportNumber>& numbers, const TraceEventDifference& difference) {
  numbers.push_back({"first_event", "first event", std::string(name(difference.event.kind))});
  numbers.push_back({"first_event_frame", "first event: frame", difference.event.frame});
  numbers.push_back({"first_event_body", "first event: body", difference.body});
  numbers.push_back(
      {"first_event_in", "first event: in", std::string(difference.inExpected ? "expected" : "actual")});
}

} // namespace

std::string describe(const TraceTolerance& tolerance) {
  return fmt::format("position {} px, velocity {} px/s, time {} s", numberText(tolerance.position),
                     numberText(tolerance.velocity), numberText(tolerance.time));
}

ReportCase reportCase(const std::string& name, const TraceComparison& comparison) {
  ReportCase result;
  result.name = name;
  result.passed = comparison.same;
  result.verdict = comparison.same ? "same" : "differs";
  result.lines = describe(comparison);

  auto& numbers = result.numbers;
  numbers.push_back({"rows_compared", "rows compared", comparison.compared});
  numbers.push_back({"rows_differing", "rows that differ", comparison.differing});
  numbers.push_back({"rows_missing", "rows missing", comparison.missing});
  numbers.push_back({"rows_extra", "rows extra", comparison.extra});
  numbers.push_back({"bodies_expected", "bodies expected", static_cast<std::int64_t>(comparison.bodies[0])});
  numbers.push_back({"bodies_actual", "bodies actual", static_cast<std::int64_t>(comparison.bodies[1])});
  numbers.push_back({"last_frame_expected", "last frame expected", comparison.lastFrame[0]});
  numbers.push_back({"last_frame_actual", "last frame actual", comparison.lastFrame[1]});
  numbers.push_back(
      {"matched_by", "matched by", std::string(comparison.match == TraceMatch::Id ? "id" : "nearest start")});
  numbers.push_back({"velocity_compared", "velocities compared", comparison.velocityCompared});
  if (comparison.first) addDeviation(numbers, "first", "first difference", *comparison.first);
  if (comparison.firstPresence) {
    numbers.push_back(
        {"first_unmatched_frame", "first frame with other bodies", comparison.firstPresence->frame});
    numbers.push_back({"first_unmatched_body", "first body in one only", comparison.firstPresence->body});
    numbers.push_back({"first_unmatched_in", "first body in one only: in",
                       std::string(comparison.firstPresence->inExpected ? "expected" : "actual")});
  }
  if (comparison.firstEvent) addEvent(numbers, *comparison.firstEvent);
  for (const auto& worst : comparison.worst) {
    if (!worst) continue;
    const std::string quantity(offstage::name(worst->quantity));
    addDeviation(numbers, "worst_" + quantity, "worst " + quantity, *worst);
  }

  if (!comparison.same) {
    result.severity = 1.0;
    for (const double error : comparison.positionError) result.severity = std::max(result.severity, error);
  }
  result.curves.push_back(
      {"position_error", "position error", "px", comparison.times, comparison.positionError});
  if (comparison.velocityCompared)
    result.curves.push_back(
        {"velocity_error", "velocity error", "px/s", comparison.times, comparison.velocityError});
  return result;
}

CompareResult compareTraceFiles(const std::filesystem::path& expected, const std::filesystem::path& actual,
                                const TraceTolerance& tolerance, std::optional<TraceMatch> match) {
  const auto start = std::chrono::steady_clock::now();
  const TraceComparison comparison = compareTraces(readTrace(expected), readTrace(actual), tolerance, match);
  CompareResult result;
  Report& report = result.report;
  report.title = fmt::format("offstage diff {} {}", expected.string(), actual.string());
  report.suite = "offstage.diff";
  report.tolerance = describe(tolerance);
  ReportCase one = reportCase(actual.filename().string(), comparison);
  one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.passed = one.passed;
  report.verdict = one.verdict;
  report.cases.push_back(std::move(one));
  return result;
}

} // namespace offstage
