#include "src/scene/trace_reader.h"

#include "src/scene/text_file.h"
#include "src/scene/trace_rows.h"

#include <algorithm>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Several million rows.
constexpr std::size_t kLargestTrace = std::size_t{1} << 30U;

class CsvTraceParser {
public:
  CsvTraceParser(std::string_view text, const std::filesystem::path& file) : cells_(text), rows_(file) {}

  Trace parse() {
    readHeader();
    rows_.errors().throwIfAny();
    while (!rows_.errors().full() && readRow()) {
    }
    return rows_.finish(has(TraceColumn::Vx));
  }

private:
  [[nodiscard]] bool has(TraceColumn column) const {
    return std::count(columns_.begin(), columns_.end(), column) > 0;
  }
  void readHeader();
  void checkHeader(std::uint32_t line);
  bool readRow();

  CsvCells cells_;
  TraceRows rows_;
  std::vector<TraceColumn> columns_;
};

void CsvTraceParser::readHeader() {
  std::uint32_t line = 1;
  while (const auto cell = cells_.next()) {
    line = cell->line;
    const TraceColumn column = traceColumn(cell->text);
    if (column != TraceColumn::Other && has(column))
      rows_.errors().add(cell->line, cell->column, fmt::format("the column '{}' is there twice", cell->text));
    columns_.push_back(column);
    if (cell->endsRow) break;
  }
  checkHeader(line);
}

/// Says all that is missing at once.
void CsvTraceParser::checkHeader(std::uint32_t line) {
  std::string missing;
  for (std::size_t i = 0; i < kRequiredTraceColumns; ++i) {
    const auto column = static_cast<TraceColumn>(i);
    if (!has(column)) missing += fmt::format("{}'{}'", missing.empty() ? "" : ", ", name(column));
  }
  if (!missing.empty()) {
    rows_.errors().add(
        line, 1,
        fmt::format("a trace's first line names its columns, separated by commas: frame, time, id, x, "
                    "y, radius and, if known, vx, vy and group; missing: {}",
                    missing));
  }
  if (has(TraceColumn::Vx) != has(TraceColumn::Vy))
    rows_.errors().add(line, 1, "a trace has both 'vx' and 'vy', or neither");
}

bool CsvTraceParser::readRow() {
  TraceRow row;
  std::size_t index = 0;
  for (bool more = true; more; ++index) {
    const auto cell = cells_.next();
    if (!cell) return false;
    if (index == 0) row.line = cell->line;
    if (index < columns_.size()) rows_.read(columns_[index], *cell, row);
    if (cells_.unclosed()) rows_.errors().add(cell->line, cell->column, "this quote is never closed");
    more = !cell->endsRow;
  }
  if (index != columns_.size()) {
    // A decimal comma, as Java's printf writes it in a German locale, is the usual reason.
    rows_.errors().add(
        row.line, 1,
        fmt::format("this line has {} cells, but the first line names {} columns{}", index, columns_.size(),
                    index > columns_.size() ? "; numbers need a decimal point, not a comma" : ""));
  }
  rows_.add(row);
  return true;
}

} // namespace

Trace readTrace(const std::filesystem::path& file) {
  return parseTrace(readTextFile(file, kLargestTrace, "a trace"), file);
}

Trace parseTrace(std::string_view text, const std::filesystem::path& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '{') return parseJsonTrace(text, file);
  return CsvTraceParser(text, file).parse();
}

} // namespace offstage
