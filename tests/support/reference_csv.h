#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace offstage::test {

/// A table of the reference data: a first line of column names, then rows of comma-separated cells.
class ReferenceCsv {
public:
  /// Reads a .csv or .csv.gz file. Throws std::runtime_error when it cannot be read or a row is not as long
  /// as the header.
  explicit ReferenceCsv(const std::filesystem::path& file);

  [[nodiscard]] std::size_t rows() const { return cells_.size(); }
  [[nodiscard]] const std::string& cell(std::size_t row, std::string_view column) const;
  [[nodiscard]] long long integer(std::size_t row, std::string_view column) const;
  /// The double of a `…_hex` column (Java's Double.toHexString), whose bits are what counts.
  [[nodiscard]] double hex(std::size_t row, std::string_view column) const;

private:
  [[nodiscard]] std::size_t columnIndex(std::string_view column) const;

  std::string file_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> cells_;
};

/// The whole text of a file, unpacked when it is a .gz.
std::string readReferenceText(const std::filesystem::path& file);

/// The lines of a text, each split at its commas.
std::vector<std::vector<std::string>> splitCsv(const std::string& text);

/// The double of a Java hex string: also "NaN", "Infinity", "-Infinity".
double parseHexDouble(const std::string& text);

/// The same bits (so −0 differs from 0); any NaN is like any other.
bool sameBits(double a, double b);

/// A double as a failure should show it: decimal and hex.
std::string show(double value);

} // namespace offstage::test
