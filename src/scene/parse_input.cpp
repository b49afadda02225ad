#include "src/scene/parse_input.h"

namespace offstage {

void parseInput(SceneBuilder& builder, const TomlValue* table, const SceneOverrides& overrides) {
  std::optional<std::filesystem::path> file = overrides.input;
  if (table != nullptr) {
    const TableReader reader(*table, {"input"}, "[input]", builder.errors);
    reader.string("log");
    if (!file) file = builder.readFile(reader, "log");
  }
  if (!file) return;
  try {
    builder.input = InputLog::read(*file);
    builder.scene.files.push_back(*file);
  } catch (const SceneError& problems) {
    builder.errors.add(problems);
    builder.input = InputLog{}; // so that launches do not complain, too
  }
}

} // namespace offstage
