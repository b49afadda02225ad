#include "src/scene/parse_input.h"

namespace offstage {

void parseInput(SceneBuilder& builder, const TomlValue* table, const SceneOverrides& overrides) {
  std::optional<std::filesystem::path> file = overrides.input;
  if (table != nullptr) {
    const TableReader reader(*table, {"input"}, "[input]", builder.errors);
    reader.string("log");
    if (!file) file = builder.readFile(reader, "log");
    builder.input.emplace(); // whatever is wrong with the log: launches should not complain, too
  }
  if (!file) return;
  try {
    builder.input = InputLog::read(*file);
    builder.scene.files.push_back(*file);
  } catch (const SceneError& problems) {
    builder.errors.add(problems);
    builder.input.emplace();
  }
}

} // namespace offstage
