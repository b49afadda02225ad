#pragma once

#include "src/scene/csv_cells.h"
#include "src/scene/error_list.h"
#include "src/scene/trace_reader.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace offstage {

/// What a trace tells of a body; the first six must be there.
enum class TraceColumn : std::uint8_t { Frame, Time, Id, X, Y, Radius, Vx, Vy, Group, Other };
inline constexpr std::size_t kRequiredTraceColumns = 6;

/// The column of this name; Other for a name that means nothing to Offstage.
TraceColumn traceColumn(std::string_view name);
std::string_view name(TraceColumn column); ///< "frame", …; of Other ""

/// Collects the rows of a trace, in whichever format it is written.
class TraceRows {
public:
  explicit TraceRows(const std::filesystem::path& file) : errors_(file.string()) {
    trace_.file = file.string();
  }

  [[nodiscard]] ErrorList& errors() { return errors_; }
  /// Takes one cell into `row`; reports at its place what is wrong with it.
  void read(TraceColumn column, const CsvCell& cell, TraceRow& row);
  void add(const TraceRow& row) { trace_.rows.push_back(row); }
  /// Sorts the rows and finds the frames. Throws SceneError with everything that is wrong.
  Trace finish(bool hasVelocity);

private:
  std::int64_t readInteger(TraceColumn column, const CsvCell& cell, bool mayBeNegative);
  double readNumber(TraceColumn column, const CsvCell& cell);
  std::uint32_t groupOf(std::string_view name);
  void sortRows();
  void findFrames();

  ErrorList errors_;
  Trace trace_;
  std::map<std::string, std::uint32_t, std::less<>> groups_;
};

/// Reads a trace of JSON lines: an object a line, its keys the columns, null where a number is none.
Trace parseJsonTrace(std::string_view text, const std::filesystem::path& file);

} // namespace offstage
