#include "src/scene/trace_reader.h"

#include "src/scene/csv_cells.h"
#include "src/scene/error_list.h"
#include "src/scene/quote.h"
#include "src/scene/text_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Several million rows.
constexpr std::size_t kLargestTrace = std::size_t{1} << 30U;

enum class Column : std::uint8_t { Frame, Time, Id, X, Y, Radius, Vx, Vy, Group, Other };

constexpr std::array<std::string_view, 9> kNames{"frame",  "time", "id", "x",    "y",
                                                 "radius", "vx",   "vy", "group"};
constexpr std::size_t kRequired = 6; ///< of kNames, from the front

class TraceParser {
public:
  TraceParser(std::string_view text, const std::filesystem::path& file)
      : cells_(text), errors_(file.string()) {
    trace_.file = file.string();
  }

  Trace parse() {
    readHeader();
    errors_.throwIfAny();
    while (!errors_.full() && readRow()) {
    }
    errors_.throwIfAny(); // rows with wrong cells would only lead to more errors below
    if (trace_.groups.empty()) trace_.groups = {"bodies"};
    sortRows();
    findFrames();
    errors_.throwIfAny();
    return std::move(trace_);
  }

private:
  void readHeader();
  void checkHeader(std::uint32_t line);
  bool readRow();
  void readCell(Column column, const CsvCell& cell, TraceRow& row);
  std::int64_t readInteger(std::string_view name, const CsvCell& cell, bool mayBeNegative);
  double readNumber(std::string_view name, const CsvCell& cell);
  std::uint32_t groupOf(std::string_view name);
  void sortRows();
  void findFrames();

  CsvCells cells_;
  ErrorList errors_;
  Trace trace_;
  std::vector<Column> columns_;
  std::map<std::string, std::uint32_t, std::less<>> groups_;
};

void TraceParser::readHeader() {
  std::uint32_t line = 1;
  while (const auto cell = cells_.next()) {
    line = cell->line;
    const auto found = std::find(kNames.begin(), kNames.end(), cell->text);
    const auto column = found == kNames.end() ? Column::Other : static_cast<Column>(found - kNames.begin());
    if (column != Column::Other && std::count(columns_.begin(), columns_.end(), column) > 0)
      errors_.add(cell->line, cell->column, fmt::format("the column '{}' is there twice", cell->text));
    columns_.push_back(column);
    if (cell->endsRow) break;
  }
  checkHeader(line);
}

/// Says all that is missing at once, with a hint where a program has written something else.
void TraceParser::checkHeader(std::uint32_t line) {
  const auto has = [this](Column column) { return std::count(columns_.begin(), columns_.end(), column) > 0; };
  std::string missing;
  for (std::size_t i = 0; i < kRequired; ++i) {
    if (!has(static_cast<Column>(i)))
      missing += fmt::format("{}'{}'", missing.empty() ? "" : ", ", kNames[i]);
  }
  if (!missing.empty()) {
    errors_.add(
        line, 1,
        fmt::format("a trace's first line names its columns, separated by commas: frame, time, id, x, "
                    "y, radius and, if known, vx, vy and group; missing: {}",
                    missing));
  }
  trace_.hasVelocity = has(Column::Vx) && has(Column::Vy);
  if (has(Column::Vx) != has(Column::Vy)) errors_.add(line, 1, "a trace has both 'vx' and 'vy', or neither");
}

bool TraceParser::readRow() {
  TraceRow row;
  std::size_t index = 0;
  std::uint32_t line = 0;
  for (bool more = true; more; ++index) {
    const auto cell = cells_.next();
    if (!cell) return false;
    if (index == 0) line = cell->line;
    if (index < columns_.size()) readCell(columns_[index], *cell, row);
    if (cells_.unclosed()) errors_.add(cell->line, cell->column, "this quote is never closed");
    more = !cell->endsRow;
  }
  if (index != columns_.size()) {
    // A decimal comma, as Java's printf writes it in a German locale, is the usual reason.
    errors_.add(line, 1,
                fmt::format("this line has {} cells, but the first line names {} columns{}", index,
                            columns_.size(),
                            index > columns_.size() ? "; numbers need a decimal point, not a comma" : ""));
  }
  row.line = line;
  trace_.rows.push_back(row);
  return true;
}

void TraceParser::readCell(Column column, const CsvCell& cell, TraceRow& row) {
  switch (column) {
  case Column::Frame:
    row.frame = readInteger("frame", cell, false);
    break;
  case Column::Id:
    row.id = readInteger("id", cell, true);
    break;
  case Column::Time:
    row.time = readNumber("time", cell);
    if (!std::isfinite(row.time))
      errors_.add(cell.line, cell.column,
                  fmt::format("'time' must be finite, but it is {}", quotedText(cell.text)));
    break;
  case Column::X:
    row.x = readNumber("x", cell);
    break;
  case Column::Y:
    row.y = readNumber("y", cell);
    break;
  case Column::Vx:
    row.vx = readNumber("vx", cell);
    break;
  case Column::Vy:
    row.vy = readNumber("vy", cell);
    break;
  case Column::Radius:
    row.radius = readNumber("radius", cell);
    break;
  case Column::Group:
    row.group = groupOf(cell.text);
    break;
  case Column::Other:
    break;
  }
}

std::int64_t TraceParser::readInteger(std::string_view name, const CsvCell& cell, bool mayBeNegative) {
  std::int64_t value = 0;
  const char* end = cell.text.data() + cell.text.size();
  const auto [stopped, problem] = std::from_chars(cell.text.data(), end, value);
  if (problem != std::errc{} || stopped != end || (value < 0 && !mayBeNegative)) {
    errors_.add(cell.line, cell.column,
                fmt::format("'{}' must be a whole number{}, but it is {}", name,
                            mayBeNegative ? "" : " of at least 0", quotedText(cell.text)));
  }
  return value;
}

double TraceParser::readNumber(std::string_view name, const CsvCell& cell) {
  double value = 0.0;
  const char* end = cell.text.data() + cell.text.size();
  const auto [stopped, problem] = std::from_chars(cell.text.data(), end, value);
  if (problem == std::errc{} && stopped == end) return value;
  errors_.add(cell.line, cell.column,
              fmt::format("'{}' must be a number{}, but it is {}", name,
                          problem == std::errc::result_out_of_range ? " that a double can hold" : "",
                          quotedText(cell.text)));
  return 0.0;
}

std::uint32_t TraceParser::groupOf(std::string_view name) {
  if (const auto found = groups_.find(name); found != groups_.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(groups_.size());
  groups_.emplace(std::string(name), index);
  trace_.groups.emplace_back(name);
  return index;
}

void TraceParser::sortRows() {
  const auto before = [](const TraceRow& a, const TraceRow& b) {
    return std::tie(a.frame, a.id, a.line) < std::tie(b.frame, b.id, b.line);
  };
  if (!std::is_sorted(trace_.rows.begin(), trace_.rows.end(), before))
    std::sort(trace_.rows.begin(), trace_.rows.end(), before);
}

void TraceParser::findFrames() {
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

} // namespace

Trace readTrace(const std::filesystem::path& file) {
  return parseTrace(readTextFile(file, kLargestTrace, "a trace"), file);
}

Trace parseTrace(std::string_view text, const std::filesystem::path& file) {
  return TraceParser(text, file).parse();
}

} // namespace offstage
