#pragma once

#include "src/scene/trace_compare.h"

#include <optional>

namespace CLI {
class App;
}

namespace offstage {

/// What a command line says of how traces are compared.
struct TraceOptions {
  std::optional<double> position; ///< px
  std::optional<double> velocity; ///< px/s
  std::optional<double> time;     ///< s
  std::optional<TraceMatch> match;

  [[nodiscard]] TraceTolerance tolerance() const;
};

/// Adds --max-position, --max-velocity, --max-time and --match.
void addTraceOptions(CLI::App& app, TraceOptions& options);

/// Throws Error(BadInput) when an option was given that means nothing to what is compared: one of the above
/// for pictures, or one that is about pictures for traces.
void requireFittingOptions(const CLI::App& verb, bool traces);

} // namespace offstage
