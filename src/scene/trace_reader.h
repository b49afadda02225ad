#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// One body in one frame. NaN and infinities stand here as the file has them.
struct TraceRow {
  std::int64_t frame = 0;  ///< ≥ 0
  std::int64_t id = 0;     ///< of the body, the same in all its frames
  double time = 0.0;       ///< s, finite, one value a frame
  double x = 0.0;          ///< px: of the centre
  double y = 0.0;          ///< px, down
  double vx = 0.0;         ///< px/s; 0 without Trace::hasVelocity
  double vy = 0.0;         ///< px/s
  double radius = 0.0;     ///< px
  std::uint32_t group = 0; ///< index into Trace::groups
  std::uint32_t line = 0;  ///< of the file, from 1
};

/// The rows of one frame: `rows[first]` up to `rows[first + count − 1]`.
struct TraceFrame {
  std::int64_t number = 0;
  double time = 0.0; ///< s
  std::size_t first = 0;
  std::size_t count = 0; ///< ≥ 1: a frame without bodies has no row, so the file does not tell of it
};

/// What a program wrote about its motion, whoever wrote it.
struct Trace {
  std::string file;
  bool hasVelocity = false;        ///< the file has both vx and vy
  std::vector<std::string> groups; ///< in order of first mention; one, "bodies", without such a column
  std::vector<TraceRow> rows;      ///< by frame, then by id, whatever the order in the file
  std::vector<TraceFrame> frames;  ///< by number; their times never go back
};

/// Reads a trace: JSON lines when it begins with a brace, else CSV as RFC 4180 has it, the first line naming
/// the columns. `frame`, `time`, `id`, `x`, `y`
/// and `radius` must be there; `vx` with `vy`, and `group`, may be; others are skipped; in any order. Empty
/// lines and lines that begin with '#' are skipped. Rows may be in any order. Throws SceneError with
/// file:line:column for every cell that is not what its column needs, for a body that is twice in a frame,
/// for a frame with two times and for times that go back.
Trace readTrace(const std::filesystem::path& file);

/// The same from text; `file` is used in messages.
Trace parseTrace(std::string_view text, const std::filesystem::path& file);

} // namespace offstage
