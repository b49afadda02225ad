#include "tests/support/reference_csv.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <zlib.h>

namespace offstage::test {

std::string readReferenceText(const std::filesystem::path& file) {
  // gzread passes files through that are not packed.
  struct Close {
    void operator()(gzFile in) const { gzclose(in); }
  };
  const std::unique_ptr<gzFile_s, Close> in(gzopen(file.c_str(), "rb"));
  if (!in) throw std::runtime_error("cannot open " + file.string());
  std::string text;
  std::array<char, 65536> block{};
  int got = 0;
  while ((got = gzread(in.get(), block.data(), static_cast<unsigned>(block.size()))) > 0) {
    text.append(block.data(), static_cast<std::size_t>(got));
  }
  if (got < 0) throw std::runtime_error("cannot unpack " + file.string());
  return text;
}

std::vector<std::vector<std::string>> splitCsv(const std::string& text) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string>& cells = lines.emplace_back();
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
  }
  return lines;
}

double parseHexDouble(const std::string& text) {
  if (text == "NaN") return std::nan("");
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end); // reads hex and "Infinity"
  if (text.empty() || *end != '\0') throw std::runtime_error("not a double: '" + text + "'");
  return value;
}

bool sameBits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string show(double value) {
  std::array<char, 80> text{};
  if (std::snprintf(text.data(), text.size(), "%.17g (%a)", value, value) < 0) return "?";
  return text.data();
}

ReferenceCsv::ReferenceCsv(const std::filesystem::path& file) : file_(file.string()) {
  cells_ = splitCsv(readReferenceText(file));
  if (cells_.empty()) throw std::runtime_error(file_ + " is empty");
  columns_ = cells_.front();
  cells_.erase(cells_.begin());
  for (const auto& row : cells_) {
    if (row.size() != columns_.size()) throw std::runtime_error(file_ + ": a row of another length");
  }
}

std::size_t ReferenceCsv::columnIndex(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) throw std::runtime_error(file_ + " has no column " + std::string(column));
  return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& ReferenceCsv::cell(std::size_t row, std::string_view column) const {
  return cells_.at(row)[columnIndex(column)];
}

long long ReferenceCsv::integer(std::size_t row, std::string_view column) const {
  return std::stoll(cell(row, column));
}

double ReferenceCsv::hex(std::size_t row, std::string_view column) const {
  return parseHexDouble(cell(row, column));
}

} // namespace offstage::test
