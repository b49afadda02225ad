#pragma once

#include "src/scene/error_list.h"
#include "src/scene/input_log.h"
#include "src/scene/look_table.h"
#include "src/scene/scene.h"
#include "src/scene/table_reader.h"
#include "src/scene/view.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace offstage {

/// A scene while it is read, and the names that its later tables may refer to. The parsers of the tables
/// (parse….h) fill it in this order: the single tables, bodies, spawns, launches, collisions, forces.
struct SceneBuilder {
  explicit SceneBuilder(const std::filesystem::path& file);

  Scene scene;
  ErrorList errors;
  View view;
  double videoSeconds =
      0.0; ///< s: how long the video is, as far as the scene itself can tell; after parseTimeline
  bool lengthIsGiven = false; ///< by a command line, in place of the scene's own clock and duration
  Integrator integrator = Integrator::SemiImplicitEuler; ///< the world's
  std::optional<InputLog> input;                         ///< [input]; empty where its log is wrong
  bool substepsGiven = false;                            ///< by [clock]
  LookTable looks;
  std::map<std::string, std::uint32_t, std::less<>> groups; ///< by name: index into WorldSetup::groups
  std::map<std::string, std::uint32_t, std::less<>> bodies; ///< by name: id
  std::map<std::string, std::uint32_t, std::less<>> lines;  ///< by a body's name: line where it was given

  // Where the entries of WorldSetup's lists stand in the file; they live in the caller's tree.
  std::vector<const TomlValue*> bodyTables;
  std::vector<const TomlValue*> spawnTables;
  std::vector<const TomlValue*> launchTables;
  /// A [[collide]] as it stands in the file. After parseCollide of all, addContacts() makes the rules of it.
  struct GroupRule {
    static constexpr std::uint32_t kAny = 0xffffffffU; ///< "*", every group
    ContactRule rule;                                  ///< either of its groups may be kAny
    std::vector<std::uint32_t> except;                 ///< that kAny does not stand for
    std::uint32_t line = 0;
    const TomlValue* table = nullptr;
  };
  std::vector<GroupRule> groupRules;
  /// By its two groups, the smaller first: index into groupRules.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> ruleOfGroups;

  /// The index of a group, which comes into being by its first mention.
  std::uint32_t addGroup(const std::string& name);
  /// The index of a group that must have bodies; an unknown name is reported at `value`.
  std::optional<std::uint32_t> findGroup(const TomlValue& value, const std::string& what);
  /// The id of a named body; an unknown name is reported at `value`.
  std::optional<std::uint32_t> findBody(const TomlValue& value, const std::string& what);
  /// `[x, y]` in the scene's units or a body's name.
  std::optional<Anchor> readAnchor(const TableReader& reader, std::string_view key);
  /// Whether the key names the pointer of the recorded input: "mouse", where no body has that name. Reported
  /// when there is no recording.
  bool isPointer(const TableReader& reader, std::string_view key);
  /// A file that the scene names: beside the scene, and there. Else reported and nothing returned.
  std::optional<std::filesystem::path> readFile(const TableReader& reader, std::string_view key);
  /// Reports when [view] has made one of a table's numbers infinite.
  void requireFinite(const TomlValue& table, const std::string& label, std::initializer_list<double> numbers);
};

/// A table of which a scene has one, `[frame]`; null when it is absent or no table, which is reported.
const TomlValue* singleTable(const TableReader& top, std::string_view key);
/// Calls `parse` for that table, if there is one.
void parseSingle(SceneBuilder& builder, const TableReader& top, std::string_view key,
                 void (*parse)(SceneBuilder&, const TomlValue&));
/// Calls `parse` for each of the tables of which a scene has any number, `[[body]]`.
void parseEach(SceneBuilder& builder, const TableReader& top, std::string_view key,
               void (*parse)(SceneBuilder&, const TomlValue&));

inline Vec2 toVec2(const std::array<double, 2>& pair) {
  return {pair[0], pair[1]};
}

// One function a table of the format. Each reads the table(s) of its name and reports every error in them.
void parseTheme(SceneBuilder& builder, const TomlValue& table); ///< before all that has a look
void parseFrame(SceneBuilder& builder, const TomlValue& table);
void parseView(SceneBuilder& builder, const TomlValue& table);
void parseWorld(SceneBuilder& builder, const TomlValue& table);
void parseWalls(SceneBuilder& builder, const TomlValue& table);
void parseBody(SceneBuilder& builder, const TomlValue& table);
void parseBodies(SceneBuilder& builder, const TomlValue& table);
void parseSpawn(SceneBuilder& builder, const TomlValue& table);
void parseLaunch(SceneBuilder& builder, const TomlValue& table);
void parseCollide(SceneBuilder& builder, const TomlValue& table);
void addContacts(SceneBuilder& builder); ///< after all [[collide]]
void parseForce(SceneBuilder& builder, const TomlValue& table);
void parseGolden(SceneBuilder& builder, const TomlValue& table); ///< after the timeline is known
void parseText(SceneBuilder& builder, const TomlValue& table);

/// Reports each body, spawn and launch with the integrator "exact" whose motion has no closed form; after all
/// tables. `startsAreKnown`: every body's numbers are right, so that its start can be judged too.
void checkExactBodies(SceneBuilder& builder, bool startsAreKnown);

/// Where a value stands, for errors that are found after the scene is read.
inline SourceLocation locationOf(const Scene& scene, const TomlValue& value) {
  return {scene.file.string(), value.line, value.column};
}

} // namespace offstage
