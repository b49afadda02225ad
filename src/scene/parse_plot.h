#pragma once

#include "src/scene/probe_name.h"
#include "src/scene/scene_builder.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// [[plot]]. After all bodies and groups, and the clock, are known.
void parsePlot(SceneBuilder& builder, const TomlValue& table);

// What [[panels.plot]] shares with it.

/// One curve, and what it is called and drawn in when the table says nothing else.
struct NamedCurve {
  NamedProbe x{.name = "t", .probe = {}, .unit = "s"};
  NamedProbe y{};
  std::string name{};
  std::optional<Color> color{}; ///< nothing: the colours go by turns
};

/// A plot of these curves as the table has it. `scene`: whose size, clock and colours it takes; `area`: where
/// it is when the table does not say. What is wrong is reported.
Plot readPlot(const TableReader& reader, const Scene& scene, std::vector<NamedCurve> curves,
              const std::array<double, 4>& area);

/// A key's value, or the values of its list; too many are reported.
std::vector<const TomlValue*> elementsOf(const TableReader& reader, std::string_view key);
/// How messages name one of `count` such values: "value 2 of 'y' in [[plot]]".
std::string describedElement(const TableReader& reader, std::string_view key, std::size_t index,
                             std::size_t count);

/// Reports a run of more frames than are plotted.
void requirePlottable(const TableReader& reader, const Clock& clock);

} // namespace offstage
