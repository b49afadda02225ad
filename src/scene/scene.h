#pragma once

#include "src/scene/golden.h"
#include "src/scene/look.h"
#include "src/scene/overlay.h"
#include "src/scene/panel.h"
#include "src/scene/plot.h"
#include "src/scene/replay.h"
#include "src/scene/text_item.h"
#include "src/scene/theme.h"
#include "src/scene/timeline.h"
#include "src/sim/clock.h"
#include "src/sim/world_setup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// A scene with every name, unit, default and reference resolved. Later stages look nothing up.
struct Scene {
  std::filesystem::path file;        ///< as given; for messages
  std::string text{};                ///< the TOML that it was read from
  std::string title;                 ///< default: the file's stem
  std::array<int, 2> size{640, 480}; ///< px: the pane, also WorldSetup::pane
  Color background{255, 255, 255, 1.0};
  double scale = 1.0;                    ///< output pixels per scene pixel
  Clock clock = Clock::fixed(60.0, 600); ///< already cut to the duration
  WorldSetup world;
  std::vector<Look> looks;                   ///< Body::look is an index into these
  std::vector<std::string> bodyNames;        ///< by id of WorldSetup::bodies; empty where unnamed
  std::vector<std::filesystem::path> files;  ///< read beside its text: dt log, body tables, recorded input
  Overlays overlays{};                       ///< what is drawn over and under the bodies
  std::vector<Plot> plots{};                 ///< drawn over the bodies, below the texts
  Panels panels{};                           ///< the worlds that are drawn instead of this one
  std::shared_ptr<const Replay> replay;      ///< null: the world is simulated; else it is empty
  std::optional<GoldenMoments> golden;       ///< what `offstage golden` keeps of it
  Timeline timeline;                         ///< what it says about its video's time
  std::vector<std::size_t> expectedWarnings; ///< kinds (Warning::what) that its run is meant to show
  Theme theme = themeOf(ThemeName::None);
  std::vector<TextItem> texts; ///< drawn over the bodies, in this order
};

/// What a command line replaces in a scene, as if it were written there.
struct SceneOverrides {
  std::optional<double> fps; ///< [clock] fps of a fixed clock; of no effect on a recorded one
  std::optional<std::filesystem::path>
      dtLog;                      ///< [clock] recorded (replaces fps); relative to the working directory
  std::optional<double> duration; ///< s
  std::optional<std::int64_t> seed;
  std::optional<double> scale;
  std::optional<std::filesystem::path> input; ///< [input] log; relative to the working directory
};

/// Reads and checks a scene file. Throws SceneError with every error of the file, or Error(BadInput) when it
/// cannot be read. Files named in it (images, dt logs) are looked for beside it and must exist; images are
/// not decoded here.
Scene loadScene(const std::filesystem::path& file, const SceneOverrides& overrides = {});

/// The same from text; `file` is used in messages and to find the files that it names.
Scene parseScene(std::string_view text, const std::filesystem::path& file,
                 const SceneOverrides& overrides = {});

/// One key that scenes may hold, as scenes/README.md documents it.
struct SceneKey {
  std::string_view table; ///< "" for the top level, "body", "frame", "force.spring", "stroke", …
  std::string_view key;
  std::string_view type;        ///< "number", "string", "[x, y]", …
  std::string_view unit;        ///< "px", "s", … or ""
  std::string_view defaultText; ///< as the reference prints it; "required" where there is none
};

/// Every key that the parser knows, grouped by table. A test holds scenes/README.md to it.
std::vector<SceneKey> sceneKeys();

} // namespace offstage
