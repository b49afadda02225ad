#pragma once

#include "src/scene/parse_body.h"
#include "src/scene/range.h"

#include <optional>
#include <span>
#include <string_view>

namespace offstage {

/// What a column of a body table holds. A column is named as the key of [[body]]; pairs may also stand in two
/// columns, and these have the names of [[spawn]] and of traces, too.
struct BodyColumn {
  enum class Kind : std::uint8_t {
    Single, ///< of BodyNumbers, one of them
    Pair,   ///< of BodyNumbers, two in one cell: "[320, 440]" or "320 440"
    Name,   ///< the body's name
    Other,  ///< any other key of [[body]]
  };
  std::string_view name; ///< of the column
  std::string_view key;  ///< the key of [[body]] that it stands for
  Kind kind = Kind::Other;
  std::array<double, 2> BodyNumbers::*pair = nullptr; ///< of a Pair, and of a Single that is half of one
  int half = 0;
  double BodyNumbers::*number = nullptr; ///< of a Single that is not
  Range range{};
  std::optional<Shape> shape{}; ///< the one shape that has this key

  /// The numbers of BodyNumbers that this column gives, as bits of a mask; 0 of the other kinds.
  [[nodiscard]] std::uint32_t mask() const;
  /// Where the numbers go.
  void put(BodyNumbers& numbers, std::span<const double> values) const;
};

/// The column of this name; nothing when no key of [[body]] is meant.
std::optional<BodyColumn> bodyColumn(std::string_view name);

/// Every name that bodyColumn() knows; for messages.
std::span<const std::string_view> bodyColumnNames();

} // namespace offstage
