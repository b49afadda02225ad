#pragma once

#include "render/compare/compare_files.h"
#include "render/compare/report.h"
#include "src/scene/trace_compare.h"

#include <filesystem>
#include <optional>
#include <string>

namespace offstage {

/// "position 0.5 px, velocity 0 px/s, time 0 s".
std::string describe(const TraceTolerance& tolerance);

/// A case of two compared traces: verdict "same" or "differs", what describe() tells of it, its numbers, and
/// the error over time as curves. Its severity is the worst error of a
/// position in px, at least 1 when they differ.
ReportCase reportCase(const std::string& name, const TraceComparison& comparison);

/// Reads and compares two traces. `match`: see compareTraces(). Throws SceneError, located, for a file that
/// is no trace.
CompareResult compareTraceFiles(const std::filesystem::path& expected, const std::filesystem::path& actual,
                                const TraceTolerance& tolerance, std::optional<TraceMatch> match);

} // namespace offstage
