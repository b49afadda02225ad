#include "src/scene/body_columns.h"

#include "src/scene/scene_keys.h"

#include <algorithm>
#include <vector>

namespace offstage {
namespace {

using Kind = BodyColumn::Kind;
using Numbers = BodyNumbers;

BodyColumn pairOf(std::string_view name, std::array<double, 2> Numbers::*pair, Range range = Range::any(),
                  std::optional<Shape> shape = {}) {
  return {name, name, Kind::Pair, pair, 0, nullptr, range, shape};
}

BodyColumn halfOf(std::string_view name, std::string_view key, std::array<double, 2> Numbers::*pair, int half,
                  Range range = Range::any(), std::optional<Shape> shape = {}) {
  return {name, key, Kind::Single, pair, half, nullptr, range, shape};
}

BodyColumn numberOf(std::string_view name, double Numbers::*number, Range range,
                    std::optional<Shape> shape = {}) {
  return {name, name, Kind::Single, nullptr, 0, number, range, shape};
}

std::vector<BodyColumn> allColumns() {
  const Range positive = Range::atLeast(0.0);
  std::vector<BodyColumn> columns{
      {"name", "name", Kind::Name},
      halfOf("x", "center", &Numbers::place, 0),
      halfOf("y", "center", &Numbers::place, 1),
      pairOf("center", &Numbers::place, Range::any(), Shape::Circle),
      halfOf("center.x", "center", &Numbers::place, 0, Range::any(), Shape::Circle),
      halfOf("center.y", "center", &Numbers::place, 1, Range::any(), Shape::Circle),
      numberOf("radius", &Numbers::radius, positive, Shape::Circle),
      pairOf("position", &Numbers::place, Range::any(), Shape::Rectangle),
      halfOf("position.x", "position", &Numbers::place, 0, Range::any(), Shape::Rectangle),
      halfOf("position.y", "position", &Numbers::place, 1, Range::any(), Shape::Rectangle),
      pairOf("size", &Numbers::size, positive, Shape::Rectangle),
      halfOf("width", "size", &Numbers::size, 0, positive, Shape::Rectangle),
      halfOf("height", "size", &Numbers::size, 1, positive, Shape::Rectangle),
      pairOf("velocity", &Numbers::velocity),
      halfOf("vx", "velocity", &Numbers::velocity, 0),
      halfOf("vy", "velocity", &Numbers::velocity, 1),
      pairOf("acceleration", &Numbers::acceleration),
      halfOf("ax", "acceleration", &Numbers::acceleration, 0),
      halfOf("ay", "acceleration", &Numbers::acceleration, 1),
      numberOf("mass", &Numbers::mass, Range::above(0.0)),
      numberOf("restitution", &Numbers::restitution, Range::between(0.0, 1.0)),
      numberOf("friction", &Numbers::friction, positive),
  };
  const std::size_t numeric = columns.size();
  for (const SceneKey& key : sceneKeyTable()) {
    if (key.table != "body") continue;
    const bool known = std::any_of(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(numeric),
                                   [&](const BodyColumn& column) { return column.name == key.key; });
    if (!known) columns.push_back({key.key, key.key, Kind::Other});
  }
  return columns;
}

const std::vector<BodyColumn>& columns() {
  static const std::vector<BodyColumn> all = allColumns();
  return all;
}

} // namespace

std::uint32_t BodyColumn::mask() const {
  if (kind != Kind::Single && kind != Kind::Pair) return 0;
  if (number == &Numbers::radius) return 0x100U;
  if (number == &Numbers::mass) return 0x200U;
  if (number != nullptr) return number == &Numbers::restitution ? 0x400U : 0x800U;
  const std::uint32_t shift = pair == &Numbers::place      ? 0U
                              : pair == &Numbers::size     ? 2U
                              : pair == &Numbers::velocity ? 4U
                                                           : 6U;
  return (kind == Kind::Pair ? 3U : 1U << static_cast<unsigned>(half)) << shift;
}

void BodyColumn::put(BodyNumbers& numbers, std::span<const double> values) const {
  if (kind == Kind::Pair) {
    numbers.*pair = {values[0], values[1]};
  } else if (number != nullptr) {
    numbers.*number = values[0];
  } else {
    (numbers.*pair)[static_cast<std::size_t>(half)] = values[0];
  }
}

std::optional<BodyColumn> bodyColumn(std::string_view name) {
  for (const BodyColumn& column : columns()) {
    if (column.name == name) return column;
  }
  return std::nullopt;
}

std::span<const std::string_view> bodyColumnNames() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const BodyColumn& column : columns()) list.push_back(column.name);
    return list;
  }();
  return names;
}

} // namespace offstage
