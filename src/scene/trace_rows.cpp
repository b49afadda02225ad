#include "src/scene/trace_rows.h"

#include "src/scene/quote.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr std::array<std::string_view, 9> kNames{"frame",  "time", "id", "x",    "y",
                                                 "radius", "vx",   "vy", "group"};

} // namespace

TraceColumn traceColumn(std::string_view name) {
  return static_cast<TraceColumn>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

std::string_view name(TraceColumn column) {
  return column == TraceColumn::Other ? std::string_view() : kNames.at(static_cast<std::size_t>(column));
}

Trace TraceRows::finish(bool hasVelocity) {
  errors_.throwIfAny(); // rows with wrong cells would only lead to more errors below
  trace_.hasVelocity = hasVelocity;
  if (trace_.groups.empty()) trace_.groups = {"bodies"};
  sortRows();
  findFrames();
  errors_.throwIfAny();
  return std::move(trace_);
}

void TraceRows::read(TraceColumn column, const CsvCell& cell, TraceRow& row) {
  switch (column) {
  case TraceColumn::Frame:
    row.frame = readInteger(column, cell, false);
    break;
  case TraceColumn::Id:
    row.id = readInteger(column, cell, true);
    break;
  case TraceColumn::Time:
    row.time = readNumber(column, cell);
    if (!std::isfinite(row.time))
      errors_.add(cell.line, cell.column,
                  fmt::format("'time' must be finite, but it is {}", quotedText(cell.text)));
    break;
  case TraceColumn::X:
    row.x = readNumber(column, cell);
    break;
  case TraceColumn::Y:
    row.y = readNumber(column, cell);
    break;
  case TraceColumn::Vx:
    row.vx = readNumber(column, cell);
    break;
  case TraceColumn::Vy:
    row.vy = readNumber(column, cell);
    break;
  case TraceColumn::Radius:
    row.radius = readNumber(column, cell);
    break;
  case TraceColumn::Group:
    row.group = groupOf(cell.text);
    break;
  case TraceColumn::Other:
    break;
  }
}

std::int64_t TraceRows::readInteger(TraceColumn column, const CsvCell& cell, bool mayBeNegative) {
  std::int64_t value = 0;
  const char* end = cell.text.data() + cell.text.size();
  const auto [stopped, problem] = std::from_chars(cell.text.data(), end, value);
  if (problem != std::errc{} || stopped != end || (value < 0 && !mayBeNegative)) {
    errors_.add(cell.line, cell.column,
                fmt::format("'{}' must be a whole number{}, but it is {}", name(column),
                            mayBeNegative ? "" : " of at least 0", quotedText(cell.text)));
  }
  return value;
}

double TraceRows::readNumber(TraceColumn column, const CsvCell& cell) {
  double value = 0.0;
  const char* end = cell.text.data() + cell.text.size();
  const auto [stopped, problem] = std::from_chars(cell.text.data(), end, value);
  if (problem == std::errc{} && stopped == end) return value;
  errors_.add(cell.line, cell.column,
              fmt::format("'{}' must be a number{}, but it is {}", name(column),
                          problem == std::errc::result_out_of_range ? " that a double can hold" : "",
                          quotedText(cell.text)));
  return 0.0;
}

std::uint32_t TraceRows::groupOf(std::string_view name) {
  if (const auto found = groups_.find(name); found != groups_.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(groups_.size());
  groups_.emplace(std::string(name), index);
  trace_.groups.emplace_back(name);
  return index;
}

void TraceRows::sortRows() {
  const auto before = [](const TraceRow& a, const TraceRow& b) {
    return std::tie(a.frame, a.id, a.line) < std::tie(b.frame, b.id, b.line);
  };
  if (!std::is_sorted(trace_.rows.begin(), trace_.rows.end(), before))
    std::sort(trace_.rows.begin(), trace_.rows.end(), before);
}

void TraceRows::findFrames() {
  const TraceRow* last = nullptr;
  for (std::size_t i = 0; i < trace_.rows.size() && !errors_.full(); ++i) {
    const TraceRow& row = trace_.rows[i];
    if (last == nullptr || last->frame != row.frame) {
      if (last != nullptr && row.time < last->time)
        errors_.add(row.line, 1,
                    fmt::format("frame {} is at {} s, before frame {} at {} s (line {})", row.frame, row.time,
                                last->frame, last->time, last->line));
      trace_.frames.push_back({row.frame, row.time, i, 0});
    } else if (last->id == row.id) {
      errors_.add(
          row.line, 1,
          fmt::format("body {} is twice in frame {}: also in line {}", row.id, row.frame, last->line));
    } else if (last->time != row.time) {
      errors_.add(row.line, 1,
                  fmt::format("frame {} is at {} s here, but at {} s in line {}", row.frame, row.time,
                              last->time, last->line));
    }
    ++trace_.frames.back().count;
    last = &row;
  }
}

} // namespace offstage
