// The words of a trace comparison.

#include "src/scene/quote.h"
#include "src/scene/trace_compare.h"

#include <fmt/core.h>

namespace offstage {
namespace {

/// "body 3", or "body 3 (actual: 5)" where it was matched with another number.
std::string bodyText(const TraceDeviation& deviation) {
  if (deviation.body == deviation.actualBody) return fmt::format("body {}", deviation.body);
  return fmt::format("body {} (actual: {})", deviation.body, deviation.actualBody);
}

std::string deviationText(const TraceDeviation& deviation) {
  return fmt::format("frame {} ({:.6g} s), {}: {} is {}, expected {} (off by {:.6g} {})", deviation.frame,
                     deviation.time, bodyText(deviation), name(deviation.quantity),
                     numberText(deviation.actual), numberText(deviation.expected), deviation.error,
                     unit(deviation.quantity));
}

std::string eventText(const TraceEventDifference& difference) {
  const TraceEvent& event = difference.event;
  const char* here = difference.inExpected ? "expected" : "actual";
  const char* there = difference.inExpected ? "actual" : "expected";
  std::string text = fmt::format("{} of body {} in frame {} ({:.6g} s) of the {} trace", name(event.kind),
                                 difference.body, event.frame, event.time, here);
  if (event.kind == TraceEventKind::BounceX || event.kind == TraceEventKind::BounceY)
    text += fmt::format(", {:.6g} to {:.6g} px/s", event.before, event.after);
  return difference.otherFrame
             ? fmt::format("{}; in the {} one not before frame {}", text, there, *difference.otherFrame)
             : fmt::format("{}; in the {} one never", text, there);
}

/// Of traces that do not end with the same frame.
std::string endsText(const std::array<std::int64_t, 2>& lastFrame) {
  const auto [expected, actual] = lastFrame;
  if (expected < 0)
    return fmt::format("the expected trace has no frame, the actual one ends with frame {}", actual);
  if (actual < 0)
    return fmt::format("the expected trace ends with frame {}, the actual one has no frame", expected);
  return fmt::format("the expected trace ends with frame {}, the actual one with frame {}", expected, actual);
}

} // namespace

std::string describe(const TraceDeviation& deviation) {
  return deviationText(deviation);
}

std::vector<std::string> describe(const TraceComparison& comparison) {
  std::vector<std::string> lines;
  const auto& presence = comparison.firstPresence;
  const auto& first = comparison.first;
  const auto tellPresence = [&] {
    lines.push_back(fmt::format("frame {} ({:.6g} s): body {} is in the {} trace only", presence->frame,
                                presence->time, presence->body,
                                presence->inExpected ? "expected" : "actual"));
  };
  if (presence && (!first || presence->frame < first->frame)) tellPresence();
  if (first) lines.push_back("first difference: " + deviationText(*first));
  if (presence && first && presence->frame >= first->frame) tellPresence();
  if (comparison.firstEvent)
    lines.push_back("first event that differs: " + eventText(*comparison.firstEvent));
  if (comparison.lastFrame[0] != comparison.lastFrame[1]) lines.push_back(endsText(comparison.lastFrame));
  for (const auto& worst : comparison.worst) {
    if (worst) lines.push_back(fmt::format("worst {}: {}", name(worst->quantity), deviationText(*worst)));
  }
  lines.push_back(fmt::format(
      "{} rows compared, {} beyond the tolerance, {} missing, {} extra; {} and {} bodies, matched by {}{}",
      comparison.compared, comparison.differing, comparison.missing, comparison.extra, comparison.bodies[0],
      comparison.bodies[1], comparison.match == TraceMatch::Id ? "id" : "nearest start",
      comparison.velocityCompared ? "" : "; velocities are not in both traces and were not compared"));
  return lines;
}

} // namespace offstage
