#pragma once

#include "src/sim/world.h"

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace offstage {

enum class TraceFormat : std::uint8_t { Csv, JsonLines };

/// Writes states, a row for every living body of every frame, in order of creation:
/// `frame,id,time,x,y,vx,vy,radius,group`, doubles in the shortest form that reads back to the same bits.
class TraceWriter {
public:
  /// `out` must outlive the writer. Writes the header of a CSV at once.
  TraceWriter(std::ostream& out, TraceFormat format, std::vector<std::string> groups);
  void write(const World& world); ///< the world's present frame
  /// One frame of any motion; `time` in s.
  void write(std::int64_t frame, double time, std::span<const Body> bodies);

private:
  std::ostream& out_;
  TraceFormat format_;
  std::vector<std::string> groups_;
  std::string buffer_;
};

/// Writes events: `frame,event,id1,id2,time,p,q`.
class EventWriter {
public:
  EventWriter(std::ostream& out, TraceFormat format);
  void write(const World& world); ///< the events of the world's last step

private:
  std::ostream& out_;
  TraceFormat format_;
  std::string buffer_;
};

} // namespace offstage
