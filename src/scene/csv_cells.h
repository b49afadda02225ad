#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace offstage {

/// One cell of a CSV text.
struct CsvCell {
  std::string_view text; ///< without quotes and the blanks around; valid until the next cell is taken
  std::uint32_t line = 0;
  std::uint32_t column = 0; ///< in bytes, from 1
  bool endsRow = false;
};

/// Takes a CSV text (RFC 4180) apart, cell by cell. Windows line ends, a byte order mark, empty lines and
/// lines that begin with '#' are skipped. A cell in quotes may hold commas, line breaks and doubled quotes.
class CsvCells {
public:
  explicit CsvCells(std::string_view text);

  /// The next cell; nothing at the end. A quote that is never closed ends with the text.
  std::optional<CsvCell> next();
  /// Whether the last cell began with a quote that nothing closes.
  [[nodiscard]] bool unclosed() const { return unclosed_; }

private:
  void skipEmptyLines();
  void takeQuoted(CsvCell& cell);
  void endCell(CsvCell& cell);

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t lineStart_ = 0;
  std::uint32_t line_ = 1;
  bool atRowStart_ = true;
  bool afterComma_ = false; ///< so that a comma at the very end still has an empty cell behind it
  bool unclosed_ = false;
  std::string unquoted_; ///< the text of the last quoted cell
};

} // namespace offstage
