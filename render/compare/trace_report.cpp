#include "render/compare/trace_report.h"

#include "src/scene/quote.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr double kWorst = 1e9; ///< stands for an error that is no number

/// For programs: people read the lines.
template <class Value>
void add(std::vector<ReportNumber>& numbers, const std::string& key, const Value& value,
         std::string_view unit = "") {
  numbers.push_back({key, "", value, std::string(unit)});
}

void addDeviation(std::vector<ReportNumber>& numbers, const std::string& key,
                  const TraceDeviation& deviation) {
  const std::string_view of = unit(deviation.quantity);
  add(numbers, key + "_frame", deviation.frame);
  add(numbers, key + "_time", deviation.time, "s");
  add(numbers, key + "_body", deviation.body);
  add(numbers, key + "_actual_body", deviation.actualBody);
  add(numbers, key + "_quantity", std::string(name(deviation.quantity)));
  add(numbers, key + "_expected", deviation.expected, of);
  add(numbers, key + "_actual", deviation.actual, of);
  add(numbers, key + "_error", deviation.error, of);
}

std::string side(bool inExpected) {
  return inExpected ? "expected" : "actual";
}

} // namespace

std::string describe(const TraceTolerance& tolerance) {
  return fmt::format("position {} px, velocity {} px/s, time {} s", numberText(tolerance.position),
                     numberText(tolerance.velocity), numberText(tolerance.time));
}

ReportCase reportCase(const std::string& caseName, const TraceComparison& comparison) {
  ReportCase result;
  result.name = caseName;
  result.passed = comparison.same;
  result.verdict = comparison.same ? "same" : "differs";
  result.lines = describe(comparison);

  auto& numbers = result.numbers;
  add(numbers, "rows_compared", comparison.compared);
  add(numbers, "rows_differing", comparison.differing);
  add(numbers, "rows_missing", comparison.missing);
  add(numbers, "rows_extra", comparison.extra);
  add(numbers, "bodies_expected", static_cast<std::int64_t>(comparison.bodies[0]));
  add(numbers, "bodies_actual", static_cast<std::int64_t>(comparison.bodies[1]));
  add(numbers, "last_frame_expected", comparison.lastFrame[0]);
  add(numbers, "last_frame_actual", comparison.lastFrame[1]);
  add(numbers, "matched_by", std::string(comparison.match == TraceMatch::Id ? "id" : "nearest"));
  add(numbers, "velocity_compared", comparison.velocityCompared);
  if (comparison.first) addDeviation(numbers, "first", *comparison.first);
  if (const auto& presence = comparison.firstPresence) {
    add(numbers, "first_unmatched_frame", presence->frame);
    add(numbers, "first_unmatched_body", presence->body);
    add(numbers, "first_unmatched_in", side(presence->inExpected));
  }
  if (const auto& event = comparison.firstEvent) {
    add(numbers, "first_event", std::string(name(event->event.kind)));
    add(numbers, "first_event_frame", event->event.frame);
    add(numbers, "first_event_time", event->event.time, "s");
    add(numbers, "first_event_body", event->body);
    add(numbers, "first_event_in", side(event->inExpected));
    if (event->otherFrame) add(numbers, "first_event_other_frame", *event->otherFrame);
  }
  for (const auto& worst : comparison.worst) {
    if (worst) addDeviation(numbers, "worst_" + std::string(name(worst->quantity)), *worst);
  }

  if (!comparison.same) {
    result.severity = 1.0;
    for (const double error : comparison.positionError)
      result.severity = std::max(result.severity, std::min(error, kWorst));
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
