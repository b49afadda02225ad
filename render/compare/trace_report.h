#pragma once

#include "render/compare/report.h"
#include "src/scene/trace_compare.h"

#include <string>

namespace offstage {

/// "position 0.5 px, velocity 0 px/s, time 0 s".
std::string describe(const TraceTolerance& tolerance);

/// A case of two compared traces: verdict "same" or "differs", what describe() tells of it, its numbers, and
/// the error over time as curves. Its severity is the worst error of a
/// position in px, at least 1 when they differ.
ReportCase reportCase(const std::string& name, const TraceComparison& comparison);

} // namespace offstage
