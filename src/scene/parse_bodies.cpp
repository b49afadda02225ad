#include "src/scene/body_cell.h"
#include "src/scene/body_columns.h"
#include "src/scene/csv_cells.h"
#include "src/scene/limits.h"
#include "src/scene/nearest.h"
#include "src/scene/quote.h"
#include "src/scene/scene_keys.h"
#include "src/scene/text_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr std::string_view kLabel = "[[bodies]]";
/// Which numbers a shape cannot be without, as bits of BodyColumn::mask().
constexpr std::uint32_t kCircleNeeds = 0x103U;
constexpr std::uint32_t kRectangleNeeds = 0x00FU;
/// Those that are one key of [[body]]: center or position, size, radius.
constexpr std::array kKeysNumbers{0x003U, 0x00CU, 0x100U};
constexpr std::array<std::pair<std::uint32_t, std::string_view>, 5> kNeeded{
    {{0x001U, "x"}, {0x002U, "y"}, {0x004U, "width"}, {0x008U, "height"}, {0x100U, "radius"}}};

/// Whether it may stand in [[bodies]].
bool isKey(std::string_view key) {
  return std::ranges::any_of(sceneKeysNamed(key), [](const SceneKey* candidate) {
    return candidate->table == "bodies" || candidate->table == "body";
  });
}

/// Bodies from the rows of a CSV file. A row's numbers are read on the spot. The rest of it is read as a
/// [[body]] of a scene is, once for all rows that agree in it, so that a hundred thousand bodies load at
/// once.
class BodyTable {
public:
  BodyTable(SceneBuilder& builder, const TomlValue& table, const std::filesystem::path& file,
            std::string_view text)
      : builder_(builder), table_(table), cells_(text), errors_(file.string()) {}

  void read() {
    readHeader();
    if (errors_.count() == 0 && defaultsAreRight()) {
      while (!errors_.full() && takeRow()) {
        if (!addBody()) break;
      }
    }
    try {
      errors_.throwIfAny();
    } catch (const SceneError& problems) {
      builder_.errors.add(problems);
    }
  }

private:
  /// What rows have in common that agree in all but their numbers and names.
  struct Kind {
    Body body;
    BodyNumbers numbers; ///< those of [[bodies]] itself
    bool right = false;
    bool shapeKnown = false; ///< what belongs to a shape can be told
  };
  struct Cell {
    std::string text;
    std::uint32_t line = 0;
    std::uint32_t column = 0;
  };

  [[nodiscard]] bool has(std::string_view column) const {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const BodyColumn& c) { return c.name == column; });
  }
  [[nodiscard]] static std::string described(const BodyColumn& column) {
    return fmt::format("'{}' of a body", column.name);
  }
  void readHeader();
  void addColumn(const CsvCell& cell);
  bool defaultsAreRight();
  bool takeRow();
  bool addBody();
  const Kind& kindOfRow();
  Kind readKind(bool ofRow);
  bool readNumbers(const Kind& kind, BodyNumbers& numbers);
  void readName(std::uint32_t id);

  SceneBuilder& builder_;
  const TomlValue& table_;
  CsvCells cells_;
  ErrorList errors_; ///< of the CSV file
  std::vector<BodyColumn> columns_;
  std::uint32_t columnMask_ = 0;  ///< numbers that have a column
  std::uint32_t defaultMask_ = 0; ///< numbers that [[bodies]] gives for all
  std::vector<Cell> row_;         ///< by column
  std::map<std::string, Kind, std::less<>> kinds_;
  std::string key_; ///< of the row: its cells that are neither numbers nor the name
};

void BodyTable::addColumn(const CsvCell& cell) {
  const std::optional<BodyColumn> column = bodyColumn(cell.text);
  if (!column) {
    const std::string_view near = nearest(cell.text, bodyColumnNames());
    const std::string hint = cell.text.find_first_of(";\t") != std::string_view::npos
                                 ? "; between the cells of a table stand commas"
                             : near.empty() ? "; the first line of a table names its columns"
                                            : fmt::format("; did you mean '{}'?", near);
    errors_.add(cell.line, cell.column,
                fmt::format("the column {} is no key of [[body]]{}", quotedText(cell.text), hint));
    return;
  }
  const bool twice = has(column->name) || (columnMask_ & column->mask()) != 0;
  if (twice)
    errors_.add(cell.line, cell.column,
                fmt::format("the column '{}' says again what another says", cell.text));
  columnMask_ |= column->mask();
  columns_.push_back(*column);
}

void BodyTable::readHeader() {
  while (const auto cell = cells_.next()) {
    if (cells_.unclosed()) return errors_.add(cell->line, cell->column, "this quote is never closed");
    addColumn(*cell);
    if (cell->endsRow || errors_.full()) break;
  }
  if (columns_.empty() && errors_.count() == 0)
    errors_.add("a table of bodies begins with a line that names its columns");
  row_.resize(columns_.size());
  for (const TomlEntry& entry : *table_.table()) {
    if (const auto column = bodyColumn(entry.key)) defaultMask_ |= column->mask();
  }
}

/// What [[bodies]] itself says is reported once, in the scene.
bool BodyTable::defaultsAreRight() {
  const std::size_t before = builder_.errors.count();
  readKind(false);
  return builder_.errors.count() == before;
}

bool BodyTable::takeRow() {
  std::size_t index = 0;
  std::uint32_t line = 0;
  for (bool more = true; more; ++index) {
    const auto cell = cells_.next();
    if (!cell) return false;
    if (index == 0) line = cell->line;
    if (index < row_.size()) {
      row_[index].text = cell->text;
      row_[index].line = cell->line;
      row_[index].column = cell->column;
    }
    if (cells_.unclosed()) {
      errors_.add(cell->line, cell->column, "this quote is never closed");
      return false;
    }
    more = !cell->endsRow;
  }
  if (index == columns_.size()) return true;
  errors_.add(line, 1,
              fmt::format("this line has {} cell{}, but the first line names {} columns{}", index,
                          index == 1 ? "" : "s", columns_.size(),
                          index > columns_.size() ? "; numbers need a decimal point, not a comma" : ""));
  return takeRow();
}

BodyTable::Kind BodyTable::readKind(bool ofRow) {
  const std::uint32_t line = ofRow ? row_.front().line : table_.line;
  const std::uint32_t column = ofRow ? 1 : table_.column;
  TomlValue merged{TomlValue::Table{}, line, column};
  auto& entries = std::get<TomlValue::Table>(merged.data);
  const auto put = [&entries](TomlEntry entry) {
    const auto there = std::find_if(entries.begin(), entries.end(),
                                    [&](const TomlEntry& other) { return other.key == entry.key; });
    if (there == entries.end()) {
      entries.push_back(std::move(entry));
    } else {
      *there = std::move(entry);
    }
  };
  for (const TomlEntry& entry : *table_.table()) {
    if (!isKey(entry.key)) continue; // parseBodies() has told so
    put(entry);
    if (!ofRow) continue;
    entries.back().line = entries.back().value.line = line;
    entries.back().column = entries.back().value.column = column;
  }
  for (std::size_t i = 0; ofRow && i < columns_.size(); ++i) {
    const Cell& cell = row_[i];
    if (columns_[i].kind != BodyColumn::Kind::Other || cell.text.empty()) continue;
    put({std::string(columns_[i].key), cell.line, cell.column,
         cellValue(columns_[i].key, cell.text, cell.line, cell.column)});
  }

  // Numbers that have a column are filled in later; for now anything stands there. Where shapes differ from
  // row to row, the defaults may be meant for either.
  const auto shapeEntry = std::find_if(entries.begin(), entries.end(),
                                       [](const TomlEntry& entry) { return entry.key == "shape"; });
  const auto* word =
      shapeEntry == entries.end() ? nullptr : std::get_if<std::string>(&shapeEntry->value.data);
  const bool rectangle = word != nullptr && *word == "rectangle";
  const bool shapeKnown = shapeEntry == entries.end() || rectangle || (word != nullptr && *word == "circle");
  const bool mixed = has("shape");
  const auto number = [&](double value) { return TomlValue{value, line, column}; };
  const auto pair = [&] { return TomlValue{TomlValue::Array{number(1.0), number(1.0)}, line, column}; };
  const auto settle = [&](const char* key, bool belongs, std::uint32_t mask, const TomlValue& any) {
    const auto there = std::find_if(entries.begin(), entries.end(),
                                    [&](const TomlEntry& entry) { return entry.key == key; });
    const bool given = there != entries.end();
    if (!belongs && mixed && given) {
      entries.erase(there);
    } else if (belongs && !given && ((columnMask_ & mask) != 0 || (mixed && !ofRow))) {
      entries.push_back({key, line, column, any});
    }
  };
  settle("center", !rectangle, 0x003U, pair());
  settle("radius", !rectangle, 0x100U, number(1.0));
  settle("position", rectangle, 0x003U, pair());
  settle("size", rectangle, 0x00CU, pair());

  Kind kind;
  kind.shapeKnown = shapeKnown;
  if (ofRow) std::swap(builder_.errors, errors_); // what is wrong now is wrong in the table
  const std::size_t before = builder_.errors.count();
  const TableReader reader(merged, {"bodies", "body"}, std::string(kLabel), builder_.errors);
  kind.body = readBody(builder_, reader, kind.numbers);
  kind.right = builder_.errors.count() == before;
  if (ofRow) std::swap(builder_.errors, errors_);
  return kind;
}

const BodyTable::Kind& BodyTable::kindOfRow() {
  key_.clear();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].kind != BodyColumn::Kind::Other) continue;
    key_ += row_[i].text;
    key_ += '\0'; // parseBodies() has refused texts that hold it
  }
  const auto found = kinds_.find(key_);
  if (found != kinds_.end() && found->second.right) return found->second;
  return kinds_.insert_or_assign(key_, readKind(true)).first->second; // what is wrong is told in every row
}

/// The row's numbers over those of [[bodies]]. False when one that the body needs is nowhere, and no row can
/// have it.
bool BodyTable::readNumbers(const Kind& kind, BodyNumbers& numbers) {
  std::uint32_t given = defaultMask_;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const BodyColumn& column = columns_[i];
    const Cell& cell = row_[i];
    if (column.mask() == 0 || cell.text.empty()) continue;
    given |= column.mask();
    if (column.shape && kind.shapeKnown && *column.shape != kind.body.shape) {
      const bool circle = kind.body.shape == Shape::Circle;
      errors_.add(cell.line, cell.column,
                  fmt::format("{} belongs to a {}, but this shape is a {}", described(column),
                              circle ? "rectangle" : "circle", circle ? "circle" : "rectangle"));
      continue;
    }
    std::array<double, 2> values{};
    std::size_t count = 2;
    if (column.kind == BodyColumn::Kind::Pair) {
      const auto pair = pairInCell(cell.text);
      if (pair) values = *pair;
      if (!pair) count = 0;
    } else {
      const auto number = numberInCell(cell.text);
      values[0] = number.value_or(0.0);
      count = number ? 1 : 0;
    }
    const std::string_view kindName =
        column.kind == BodyColumn::Kind::Pair ? "two finite numbers" : "a finite number";
    if (count == 0) {
      errors_.add(
          cell.line, cell.column,
          fmt::format("{} must be {}, but it is {}", described(column), kindName, quotedText(cell.text)));
      continue;
    }
    const std::span<const double> all(values.data(), count);
    if (!std::all_of(all.begin(), all.end(), [&](double value) { return column.range.contains(value); })) {
      errors_.add(cell.line, cell.column,
                  fmt::format("{} must be {}, but it is {}", described(column), column.range.text(),
                              quotedText(cell.text)));
      continue;
    }
    column.put(numbers, all);
  }
  std::uint32_t missing = (kind.body.shape == Shape::Circle ? kCircleNeeds : kRectangleNeeds) & ~given;
  for (const std::uint32_t key : kKeysNumbers)
    if ((columnMask_ & key) == 0) missing &= ~key; // readKind() has told that nothing gives the key
  if (missing == 0 || !kind.shapeKnown) return true;
  std::string names;
  for (const auto& [bit, name] : kNeeded) {
    if ((missing & bit) != 0) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", name);
  }
  const bool nowhere = (missing & ~columnMask_) != 0;
  errors_.add(row_.front().line, 1,
              fmt::format("a {} needs {}, and {}", kind.body.shape == Shape::Circle ? "circle" : "rectangle",
                          names, nowhere ? "the table has no such column" : "the cell is empty"));
  return !nowhere;
}

void BodyTable::readName(std::uint32_t id) {
  std::string& stored = builder_.scene.bodyNames.emplace_back();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Cell& cell = row_[i];
    if (columns_[i].kind != BodyColumn::Kind::Name || cell.text.empty()) continue;
    stored = cell.text;
    if (!addBodyName(builder_, stored, id, cell.line))
      errors_.add(cell.line, cell.column,
                  fmt::format("the name {} is another body's", quotedText(cell.text)));
  }
}

bool BodyTable::addBody() {
  const Kind& kind = kindOfRow();
  const auto id = static_cast<std::uint32_t>(builder_.scene.world.bodies.size());
  readName(id);
  BodyNumbers numbers = kind.numbers;
  if (!readNumbers(kind, numbers)) return false;
  Body body = placed(builder_.view, numbers, kind.body);
  body.id = id;
  if (!isFinite(body))
    errors_.add(row_.front().line, 1, "a number of this body is too large for this [view]");
  builder_.scene.world.bodies.push_back(body);
  builder_.bodyTables.push_back(&table_);
  return true;
}

} // namespace

void parseBodies(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"bodies", "body"}, std::string(kLabel), builder.errors);
  reader.string("table");
  if (reader.has("name")) {
    reader.reject("name", "cannot be the same for all bodies of a table: give it a column");
    return;
  }
  const auto file = builder.readFile(reader, "table");
  if (!file) return;
  try {
    const std::string text = readTextFile(*file, kMaxTableBytes, "a table of bodies");
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
      throw SceneError(file->string(), "a table of bodies is text, but this file holds a zero byte");
    BodyTable(builder, table, *file, text).read();
    builder.scene.files.push_back(*file);
  } catch (const SceneError& problems) {
    builder.errors.add(problems);
  }
}

} // namespace offstage
