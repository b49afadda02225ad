#include "src/scene/parse_text.h"

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr Choice<ThemeName> kNames[] = {
    {"light", ThemeName::Light}, {"dark", ThemeName::Dark}, {"plain", ThemeName::Plain}};

void readPalette(const TableReader& reader, std::vector<Color>& palette) {
  const TomlValue* list = reader.find("palette");
  if (list == nullptr) return;
  const std::string what = reader.described("palette");
  if (list->array() == nullptr || list->array()->empty()) {
    reportMismatch(*list, what, "a list of at least one colour", reader.errors());
    return;
  }
  palette.clear();
  for (std::size_t i = 0; i < list->array()->size(); ++i) {
    const auto color =
        readColor((*list->array())[i], fmt::format("value {} of {}", i + 1, what), reader.errors());
    palette.push_back(color.value_or(Color{}));
  }
}

} // namespace

void parseTheme(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"theme"}, "[theme]", builder.errors);
  Theme& theme = builder.scene.theme;
  theme = themeOf(reader.choice("name", kNames));
  theme.background = readGivenColor(reader, "background").value_or(theme.background);
  theme.text = readGivenColor(reader, "text").value_or(theme.text);
  theme.muted = readGivenColor(reader, "muted").value_or(theme.muted);
  theme.grid = readGivenColor(reader, "grid").value_or(theme.grid);
  readPalette(reader, theme.palette);
  if (reader.has("palette")) theme.bodies = true;
}

} // namespace offstage
