#include "src/scene/scene.h"
#include "tests/support/scene_dump.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using ::testing::IsEmpty;

/// What the reference says of one key, or the parser's list.
struct DocumentedKey {
  std::string table, key, type, unit, defaultText;
  friend bool operator==(const DocumentedKey&, const DocumentedKey&) = default;
};

void PrintTo(const DocumentedKey& key, std::ostream* out) {
  *out << fmt::format("[{}] {} | {} | {} | {}", key.table, key.key, key.type, key.unit, key.defaultText);
}

std::string withoutBackticks(std::string text) {
  std::erase(text, '`');
  return text;
}

/// The name in sceneKeys() of the table that a heading of the reference documents; "-" for other headings.
std::string tableOfHeading(const std::string& heading) {
  const std::string text = withoutBackticks(heading.substr(heading.find_first_not_of("# ")));
  if (text == "Top of the file") return "";
  if (text.starts_with("fill =")) return "fill";
  if (text.starts_with("stroke =")) return "stroke";
  if (text.starts_with("{ int")) return "random";
  const std::string kForceType = "[[force]] type = \"";
  if (text.starts_with(kForceType))
    return "force." + text.substr(kForceType.size(), text.size() - kForceType.size() - 1);
  if (!text.starts_with('[')) return "-";
  const std::size_t begin = text.find_first_not_of('[');
  return text.substr(begin, text.find(']') - begin);
}

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> result;
  std::istringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    result.push_back(withoutBackticks(cell.substr(begin, cell.find_last_not_of(' ') - begin + 1)));
  }
  return result;
}

std::vector<DocumentedKey> keysOfTheReference() {
  std::ifstream in(OFFSTAGE_SOURCE_DIR "/scenes/README.md");
  if (!in) throw std::runtime_error("scenes/README.md cannot be read");
  std::vector<DocumentedKey> keys;
  std::string table = "-";
  bool inKeys = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) table = tableOfHeading(line);
    if (!line.starts_with('|')) {
      inKeys = false;
    } else if (line.starts_with("| key |")) {
      inKeys = true;
    } else if (inKeys && !line.starts_with("|---")) {
      const std::vector<std::string> columns = cells(line);
      if (columns.size() != 5) throw std::runtime_error("not five columns: " + line);
      keys.push_back({table, columns[0], columns[1], columns[2] == "–" ? "" : columns[2], columns[3]});
    }
  }
  return keys;
}

std::vector<DocumentedKey> keysOfTheParser() {
  std::vector<DocumentedKey> keys;
  for (const SceneKey& key : sceneKeys()) {
    keys.push_back({std::string(key.table), std::string(key.key), std::string(key.type),
                    std::string(key.unit), std::string(key.defaultText)});
  }
  return keys;
}

using Entries = std::vector<std::pair<std::string, std::string>>;

/// The required entries of each table.
Entries baseOf(const std::string& table) {
  static const std::map<std::string, Entries> bases = {
      {"input", {{"log", "\"keys.log\""}}},
      {"body", {{"center", "[10, 20]"}, {"radius", "5"}}},
      {"bodies", {{"table", "\"circles.csv\""}}},
      {"fill", {{"image", "\"image.png\""}}},
      {"random", {{"uniform", "[1, 2]"}}},
      {"spawn", {{"x", "1"}, {"y", "2"}, {"radius", "3"}}},
      {"launch", {{"at", "1"}, {"from", "[0, 0]"}, {"toward", "[1, 1]"}, {"speed", "2"}, {"radius", "1"}}},
      {"collide", {{"between", "[\"bodies\", \"bodies\"]"}}},
      {"force", {{"type", "\"drag\""}}},
      {"force.drag", {{"type", "\"drag\""}}},
      {"force.spring", {{"type", "\"spring\""}, {"to", "[1, 2]"}, {"stiffness", "3"}}},
      {"force.attract", {{"type", "\"attract\""}, {"to", "[1, 2]"}, {"strength", "3"}}},
      {"force.wind", {{"type", "\"wind\""}, {"velocity", "[1, 2]"}, {"coefficient", "3"}}},
      {"force.expression", {{"type", "\"expression\""}, {"fx", "\"1\""}, {"fy", "\"2\""}}},
      {"replay", {{"trace", "\"student.csv\""}}},
      {"replay.look", {{"id", "2"}}},
      {"golden", {{"at", "[0.5]"}}},
      {"ruler", {{"from", "[10, 20]"}, {"to", "[30, 40]"}}},
      {"plot", {{"y", "\"energy\""}}},
      {"panels.plot", {{"y", "\"energy\""}, {"area", "[10, 20, 300, 200]"}}},
      {"section", {{"title", "\"b\""}, {"start", "1"}}},
      {"caption", {{"text", "\"a\""}, {"from", "0.25"}, {"to", "0.75"}}},
      {"pause", {{"at", "0.5"}, {"for", "1"}}},
      {"speed", {{"factor", "2"}}},
      {"camera", {{"at", "1"}}},
      {"narration", {{"file", "\"image.png\""}}},
      {"text", {{"text", "\"b\""}, {"place", "\"top\""}}},
  };
  const auto found = bases.find(table);
  return found == bases.end() ? Entries{} : found->second;
}

void set(Entries& entries, const std::string& key, const std::string& value) {
  std::erase_if(entries, [&](const auto& entry) { return entry.first == key; });
  entries.emplace_back(key, value);
}

/// Adds a key to a table's base, with what it needs beside it and without what it cannot stand beside.
Entries with(const std::string& table, const std::string& key, const std::string& value) {
  Entries entries = baseOf(table);
  const auto drop = [&entries](std::initializer_list<const char*> keys) {
    for (const char* dropped : keys)
      std::erase_if(entries, [&](const auto& entry) { return entry.first == dropped; });
  };
  if ((table == "body" || table == "spawn") &&
      (key == "position" || key == "size" || key == "width" || key == "height")) {
    drop({"center", "radius", "x", "y"});
    set(entries, "shape", "\"rectangle\"");
    set(entries, "position", "[1, 2]");
    if (key == "width" || key == "height") {
      set(entries, "width", "3");
      set(entries, "height", "4");
    } else {
      set(entries, "size", "[3, 4]");
    }
  }
  if (table == "spawn" && key == "center") drop({"x", "y"});
  if (table == "launch" && (key == "frame" || key == "on")) drop({"at"});
  if (table == "fill" && key == "cycle") drop({"image"});
  if (table == "replay.look" && key == "group") drop({"id"});
  if (table == "golden" && key == "every") drop({"at"});
  if (table == "random") drop({"uniform"});
  if (table == "clock" && key == "dt") set(entries, "step", "\"fixed\"");
  if (table == "ghost" && key == "fade") set(entries, "length", "1");
  if (table == "caption" && (key == "on" || key == "body" || key == "limit")) {
    drop({"from", "to"});
    set(entries, "on", "\"bounce\"");
  }
  if (table == "caption" && key == "for") drop({"to"});
  if (table == "pause" && (key == "style" || key == "color")) set(entries, "highlight", "[\"b\"]");
  if (table == "text" && key == "at") drop({"place"});
  if (table == "text" && key == "formula") drop({"text"});
  if (table == "text" && key == "padding") set(entries, "background", "\"red\"");
  if (table == "text" && key == "outline_width") set(entries, "outline", "\"red\"");
  if (table == "stroke" && (key == "anchor" || key == "proportional")) set(entries, "image", "\"image.png\"");
  if ((table == "fill" || table == "stroke") && key == "proportional") set(entries, "anchor", "[0, 0, 1, 1]");
  if (table == "world" && key == "iterations") set(entries, "contacts", "\"solver\"");
  if (table == "collide" && key == "except") set(entries, "between", "[\"*\", \"*\"]");
  if (!key.empty()) set(entries, key, value);
  return entries;
}

/// A whole scene in which the table has these entries.
std::string sceneWith(const std::string& table, const Entries& entries) {
  std::string lines;
  std::string inlined;
  for (const auto& [key, value] : entries) {
    lines += fmt::format("{} = {}\n", key, value);
    inlined += fmt::format("{}{} = {}", inlined.empty() ? "" : ", ", key, value);
  }
  if (table == "replay") return "[replay]\n" + lines;
  if (table == "replay.look") return "[replay]\ntrace = \"student.csv\"\n[[replay.look]]\n" + lines;
  const std::string body = "[[body]]\nname = \"b\"\ncenter = [1, 2]\nradius = 3\n";
  const std::string spawn = "[[spawn]]\nx = 1\ny = 2\nradius = 3\n";
  if (table.empty()) return lines;
  if (table == "fill") return spawn + "fill = { " + inlined + " }\n";
  if (table == "stroke") return spawn + "stroke = { " + inlined + " }\n";
  if (table == "random") return spawn + "vx = { " + inlined + " }\n";
  if (table == "launch") return body + "[input]\nlog = \"keys.log\"\n[[launch]]\n" + lines;
  if (table.starts_with("force")) return body + "[[force]]\n" + lines;
  const std::string section = "[[section]]\ntitle = \"b\"\nstart = 0\n";
  if (table == "caption" || table == "camera") return body + section + "[[" + table + "]]\n" + lines;
  static const std::set<std::string> tables = {
      "body",  "bodies",       "spawn", "launch", "collide", "trail", "ghost",   "outline", "mark",
      "arrow", "contact_mark", "ruler", "panel",  "plot",    "text",  "section", "pause",   "speed"};
  const bool many = tables.contains(table);
  const std::string two = "[[panel]]\n[[panel]]\n";
  if (table == "panels") return body + two + "[panels]\n" + lines;
  if (table == "panels.plot") return body + two + "[[panels.plot]]\n" + lines;
  return body + (many ? "[[" + table + "]]\n" : "[" + table + "]\n") + lines;
}

/// The entries that a table of which there are many needs, as a table in braces has them.
std::string tableOf(const std::string& key) {
  std::string table;
  for (const auto& [name, value] : baseOf(key == "force" ? "force.drag" : key))
    table += fmt::format("{}{} = {}", table.empty() ? "" : ", ", name, value);
  return table;
}

/// A value of the documented type.
std::string valueOf(const DocumentedKey& key) {
  static const std::map<std::string, std::string> values = {
      {"number", "0.5"},
      {"integer", "2"},
      {"string", "\"b\""},
      {"colour", "\"red\""},
      {"paint", "\"#0f08\""},
      {"[x, y]", "[3, 4.5]"},
      {"[width, height]", "[3, 4]"},
      {"[x, y, width, height]", "[0, 0.5, 1, 2]"},
      {"list of colours", "[\"red\", \"#0f0\"]"},
      {"random number", "{ int = 7 }"},
      {"[low, high]", "[1, 2]"},
      {"[mean, deviation]", "[1, 2]"},
      {"number or list", "[0.5, 1]"},
      {"list of numbers", "[0.5, 1]"},
      {"list of names", "[\"b\"]"},
      {"list of words", "[\"step\"]"},
      {"list of groups", "[\"bodies\"]"},
      {"list of [x, y, width, height]", "[[1, 2, 3, 4]]"},
      {"file or list", "\"image.png\""},
      {"integer or list", "[5, 6]"},
      {"[x, y] or name", "\"b\""},
      {"value or list", "[\"b.x\", \"t\"]"},
      {"panel or list", "[2, 1]"},
      {"string or list", "\"b\""},
      {"colour or list", "[\"red\"]"},
      {"name or list", "[\"b\", \"bodies\"]"},
      {"[group, group]", "[\"bodies\", \"bodies\"]"},
      {"expression", "\"x + 1\""},
      {"key or button", "\"key SPACE\""},
      {"choice or file", "\"mono\""},
      {"table", "{}"},
  };
  // Words and truths other than the default, so that they have an effect.
  static const std::map<std::string, std::string> words = {
      {"quantity", "force"},    {"integrator", "rk4"}, {"shape", "circle"},    {"align", "inside"},
      {"step", "fixed"},        {"count", "alive"},    {"response", "report"}, {"type", "drag"},
      {"when", "after-update"}, {"place", "bottom"},   {"anchor", "left"},     {"style", "dim"},
      {"easing", "in"},         {"on", "collide"},     {"contacts", "solver"},
  };
  if (key.type == "boolean") return key.defaultText == "true" ? "false" : "true";
  if (key.table == "panel" && key.type == "tables") return "[{ " + tableOf(key.key) + " }]";
  if (key.key == "panels") return "{ gap = 2 }\npanel = [{}]";
  if (key.key == "layout") return "\"overlaid\"";
  if (key.key == "x_scale" || key.key == "y_scale") return "\"log\"";
  if (key.table == "plot" && key.key == "area") return "[10, 20, 300, 200]";
  if (key.key == "text_size") return "20.5";
  if (key.key == "columns") return "1";
  if (key.table == "plot" && key.key == "legend") return "true";
  if (key.table == "plot" && key.key == "x") return "[\"b.x\"]";
  if (key.table == "panels" && key.key == "size") return "[900, 700]";
  if (key.key == "layer") return key.defaultText == "\"front\"" ? "\"behind\"" : "\"front\"";
  if (key.table == "mark" && key.key == "shape") return "\"dot\"";
  if (key.key == "leaving") return key.defaultText == "\"keep\"" ? "\"remove\"" : "\"keep\"";
  if (key.table == "theme" && key.key == "name") return "\"dark\"";
  if (key.table == "text" && key.key == "align") return "\"right\"";
  if (key.table == "text" && key.key == "size") return "20.5";
  if (key.type == "choice") return '"' + words.at(key.key) + '"';
  if (key.key == "name") return "\"another\"";
  if (key.key == "recorded") return "\"log.dt\"";
  if (key.key == "log") return "\"keys.log\"";
  if (key.key == "input") return "{ log = \"keys.log\" }";
  if (key.key == "table") return "\"circles.csv\"";
  if (key.key == "trace") return "\"student.csv\"";
  if (key.key == "replay") return "{ trace = \"student.csv\" }";
  if (key.key == "narration" && key.table.empty()) return "{ file = \"image.png\" }";
  if (key.key == "golden") return "{ at = [1] }";
  if (key.key == "look") return "[{ id = 2, fill = \"red\" }]";
  if (key.table == "force" && key.key == "group") return "\"bodies\"";
  if (key.type == "file") return "\"image.png\"";
  if (key.type == "table" && key.key == "stroke") return "{ width = 2 }";
  if (key.type == "tables") {
    if (key.table == "panels" && key.key == "plot") return "[{ " + tableOf("panels.plot") + " }]";
    if (key.key != "collide") return "[{ " + tableOf(key.key) + " }]";
    // A rule needs a group that has a body.
    return "[{ between = [\"bodies\", \"bodies\"] }]\nbody = [{ center = [1, 2], radius = 3 }]";
  }
  const auto found = values.find(key.type);
  if (found == values.end()) throw std::runtime_error("unknown type in the reference: " + key.type);
  return found->second;
}

class SceneReference : public ::testing::Test {
protected:
  SceneReference() {
    folder_.write("image.png", "only looked for, not read");
    folder_.write("log.dt", "16666667\n");
    folder_.write("keys.log", "0.5 key down SPACE\n");
    folder_.write("circles.csv", "x,y,radius\n1,2,3\n");
    folder_.write("student.csv",
                  "frame,time,id,x,y,radius,group\n0,0,0,1,2,3,a\n0,0,2,1,2,3,b\n1,1,2,1,2,3,b\n");
  }

  [[nodiscard]] std::vector<std::string> errorsOf(const std::string& text) const {
    std::vector<std::string> errors;
    try {
      static_cast<void>(parseScene(text, folder_.path() / "scene.toml"));
    } catch (const SceneError& problems) {
      for (const Diagnostic& diagnostic : problems.diagnostics()) errors.push_back(diagnostic.message);
    }
    return errors;
  }

  [[nodiscard]] std::string dumpOf(const std::string& text) const {
    return test::dump(parseScene(text, folder_.path() / "scene.toml"));
  }

private:
  test::TempDir folder_;
};

TEST_F(SceneReference, ListsTheParsersKeysWithTheirTypesUnitsAndDefaults) {
  EXPECT_THAT(keysOfTheReference(), ::testing::ElementsAreArray(keysOfTheParser()));
  EXPECT_GT(keysOfTheParser().size(), 100U);
}

TEST_F(SceneReference, NamesEachKeyOnce) {
  auto keys = keysOfTheParser();
  std::sort(keys.begin(), keys.end(),
            [](const auto& a, const auto& b) { return std::tie(a.table, a.key) < std::tie(b.table, b.key); });
  const auto twice = std::adjacent_find(keys.begin(), keys.end(), [](const auto& a, const auto& b) {
    return a.table == b.table && a.key == b.key;
  });
  EXPECT_EQ(twice, keys.end()) << twice->table << '.' << twice->key;
}

TEST_F(SceneReference, EveryTableIsReadWithOnlyWhatItNeeds) {
  for (const DocumentedKey& key : keysOfTheParser()) {
    if (key.table == "random") continue; // needs any one of its keys
    const std::string text = sceneWith(key.table, baseOf(key.table));
    EXPECT_THAT(errorsOf(text), IsEmpty()) << text;
  }
}

TEST_F(SceneReference, EveryKeyTakesAValueOfItsType) {
  for (const DocumentedKey& key : keysOfTheReference()) {
    const std::string text = sceneWith(key.table, with(key.table, key.key, valueOf(key)));
    EXPECT_THAT(errorsOf(text), IsEmpty()) << text;
  }
}

TEST_F(SceneReference, EveryKeyRefusesAValueOfAnotherType) {
  for (const DocumentedKey& key : keysOfTheReference()) {
    const std::string text = sceneWith(key.table, with(key.table, key.key, "[[true]]")); // no key takes that
    const auto errors = errorsOf(text);
    ASSERT_FALSE(errors.empty()) << text;
    const bool named = std::any_of(errors.begin(), errors.end(), [&](const std::string& error) {
      return error.find(key.key + "'") != std::string::npos;
    });
    EXPECT_TRUE(named) << text << errors.front();
  }
}

TEST_F(SceneReference, EveryRequiredKeyIsMissedWhereItIsNeeded) {
  for (const DocumentedKey& key : keysOfTheReference()) {
    if (key.defaultText != "required") continue;
    Entries entries = with(key.table, key.key, valueOf(key));
    std::erase_if(entries, [&](const auto& entry) { return entry.first == key.key; });
    const auto errors = errorsOf(sceneWith(key.table, entries));
    ASSERT_FALSE(errors.empty()) << sceneWith(key.table, entries);
    EXPECT_NE(errors.front().find("needs"), std::string::npos) << errors.front();
  }
}

TEST_F(SceneReference, TheDocumentedDefaultIsTheDefault) {
  int compared = 0;
  for (const DocumentedKey& key : keysOfTheReference()) {
    const bool isLiteral = std::string("\"[0123456789tf").find(key.defaultText[0]) != std::string::npos &&
                           !key.defaultText.starts_with("the ");
    if (!isLiteral) continue;
    // The key's neighbours stay: only the key itself is given or left out.
    Entries entries = with(key.table, key.key, key.defaultText);
    const std::string given = sceneWith(key.table, entries);
    std::erase_if(entries, [&](const auto& entry) { return entry.first == key.key; });
    const std::string left = sceneWith(key.table, entries);
    ASSERT_THAT(errorsOf(given), IsEmpty()) << given;
    ASSERT_THAT(errorsOf(left), IsEmpty()) << left;
    EXPECT_EQ(dumpOf(given), dumpOf(left)) << given;
    ++compared;
  }
  EXPECT_GT(compared, 60);
}

TEST_F(SceneReference, EveryKeyHasAnEffect) {
  for (const DocumentedKey& key : keysOfTheReference()) {
    if (key.type == "table" && key.key != "stroke") continue; // empty, it says nothing
    if (key.key == "shape") continue;                         // another one needs other keys
    Entries entries = with(key.table, key.key, valueOf(key));
    const std::string given = sceneWith(key.table, entries);
    std::erase_if(entries, [&](const auto& entry) { return entry.first == key.key; });
    const std::string left = sceneWith(key.table, entries);
    if (!errorsOf(left).empty()) continue; // a required key
    EXPECT_NE(dumpOf(given), dumpOf(left)) << given;
  }
}

TEST_F(SceneReference, TheExamplesOfTheReferenceAreScenes) {
  std::ifstream in(OFFSTAGE_SOURCE_DIR "/scenes/README.md");
  std::string example;
  bool inExample = false;
  int examples = 0;
  for (std::string line; std::getline(in, line);) {
    if (line == "```toml") {
      inExample = true;
      example.clear();
    } else if (line == "```" && inExample) {
      inExample = false;
      ++examples;
      const auto errors = errorsOf(example);
      // Files and bodies that an example only mentions are not there; nothing else may be wrong.
      for (const std::string& error : errors) {
        EXPECT_TRUE(error.find("does not exist beside the scene") != std::string::npos ||
                    error.find("names an unknown body, \"target\"") != std::string::npos)
            << error << '\n'
            << example;
      }
    } else if (inExample) {
      example += line + '\n';
    }
  }
  EXPECT_GE(examples, 7);
}

} // namespace
} // namespace offstage
