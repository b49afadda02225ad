#include "src/scene/csv_cells.h"

#include <algorithm>

namespace offstage {
namespace {

bool isBlank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

} // namespace

CsvCells::CsvCells(std::string_view text) : text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3); // the byte order mark of some editors
}

void CsvCells::skipEmptyLines() {
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    if (!line.starts_with('#') && !trimmed(line).empty()) return;
    at_ = end < text_.size() ? end + 1 : end;
    lineStart_ = at_;
    ++line_;
  }
}

std::optional<CsvCell> CsvCells::next() {
  if (atRowStart_) skipEmptyLines();
  if (at_ >= text_.size() && !afterComma_) return std::nullopt;
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;

  CsvCell cell;
  cell.line = line_;
  cell.column = static_cast<std::uint32_t>(at_ - lineStart_) + 1;
  if (at_ < text_.size() && text_[at_] == '"') {
    takeQuoted(cell);
  } else {
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n') ++at_;
    cell.text = trimmed(text_.substr(begin, at_ - begin));
  }
  endCell(cell);
  return cell;
}

void CsvCells::takeQuoted(CsvCell& cell) {
  unquoted_.clear();
  unclosed_ = true;
  for (++at_; at_ < text_.size(); ++at_) {
    const char letter = text_[at_];
    if (letter == '"') {
      const bool doubled = at_ + 1 < text_.size() && text_[at_ + 1] == '"';
      if (!doubled) {
        unclosed_ = false;
        ++at_;
        break;
      }
      ++at_;
    } else if (letter == '\n') {
      ++line_;
      lineStart_ = at_ + 1;
    }
    unquoted_ += letter;
  }
  // What stands behind the closing quote belongs to the cell, so that it is seen and refused.
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n') ++at_;
  unquoted_ += trimmed(text_.substr(begin, at_ - begin));
  cell.text = unquoted_;
}

void CsvCells::endCell(CsvCell& cell) {
  afterComma_ = at_ < text_.size() && text_[at_] == ',';
  cell.endsRow = !afterComma_;
  atRowStart_ = cell.endsRow;
  if (at_ < text_.size()) ++at_;
  if (!cell.endsRow) return;
  ++line_;
  lineStart_ = at_;
}

} // namespace offstage
