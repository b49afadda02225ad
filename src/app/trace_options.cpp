#include "src/app/trace_options.h"

#include "render/job/number_option.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace offstage {
namespace {

constexpr std::array<std::string_view, 4> kOfTraces{"--max-position", "--max-velocity", "--max-time",
                                                    "--match"};
constexpr std::array<std::string_view, 3> kOfBoth{"--json", "--junit", "--html"};

bool isAmong(const std::string& name, std::span<const std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

TraceTolerance TraceOptions::tolerance() const {
  return {position.value_or(0.0), velocity.value_or(0.0), time.value_or(0.0)};
}

void addTraceOptions(CLI::App& app, TraceOptions& options) {
  constexpr double kMost = std::numeric_limits<double>::max();
  addNumber(app, "--max-position", options.position, "PX",
            "of traces: x, y and radius may be off by so much (default 0)", 0.0, kMost);
  addNumber(app, "--max-velocity", options.velocity, "PX/S",
            "of traces: vx and vy may be off by so much (default 0)", 0.0, kMost);
  addNumber(app, "--max-time", options.time, "S",
            "of traces: a frame's time may be off by so much (default 0)", 0.0, kMost);
  app.add_option_function<std::string>(
         "--match",
         [&options](const std::string& word) {
           if (word != "id" && word != "nearest")
             throw Error(ExitCode::BadInput, fmt::format("--match '{}' is not id or nearest", word));
           options.match = word == "id" ? TraceMatch::Id : TraceMatch::Nearest;
         },
         "of traces: which bodies are the same, by their id or by their nearest start (default: id when both "
         "have the same ids)")
      ->type_name("id|nearest");
}

void requireFittingOptions(const CLI::App& verb, bool traces) {
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || !name.starts_with("--") || isAmong(name, kOfBoth)) continue;
    if (isAmong(name, kOfTraces) == traces) continue;
    throw Error(ExitCode::BadInput,
                fmt::format("{} means nothing to {}", name, traces ? "traces" : "pictures; it is of traces"));
  }
}

} // namespace offstage
