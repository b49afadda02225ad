#pragma once

#include "src/scene/trace_reader.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace offstage {

/// The life of one body in a trace.
struct TraceBody {
  std::int64_t id = 0;
  std::vector<std::size_t> rows; ///< indices into Trace::rows, frame by frame; not empty
};

/// Every body of a trace, by id.
std::vector<TraceBody> traceBodies(const Trace& trace);

/// How the bodies of two traces belong together.
enum class TraceMatch : std::uint8_t {
  Id,      ///< the same id
  Nearest, ///< the nearest start: programs number their bodies as they like
};

/// Two bodies that are the same one, as indices into the two lists; one of them nothing: it has no partner.
struct TracePair {
  std::optional<std::size_t> expected;
  std::optional<std::size_t> actual;
};

/// Whether both lists hold the same ids.
bool sameIds(const std::vector<TraceBody>& expected, const std::vector<TraceBody>& actual);

/// Matches bodies one to one, each at most once. By nearest start: of all pairs that start at most half a
/// second apart, the ones with the least distance in frames first, among these the least distance between
/// their first positions; the rest has no partner. Pairs come in the order of the expected bodies, then the
/// actual ones without a partner.
std::vector<TracePair> matchBodies(const Trace& expected, const std::vector<TraceBody>& expectedBodies,
                                   const Trace& actual, const std::vector<TraceBody>& actualBodies,
                                   TraceMatch match);

} // namespace offstage
