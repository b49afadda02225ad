#include "render/job/still.h"

#include "render/job/command_line.h"
#include "render/job/console.h"
#include "render/job/number_option.h"
#include "render/job/output_places.h"
#include "render/job/poster.h"
#include "render/output/atomic_file.h"
#include "render/output/output_kind.h"
#include "render/output/png.h"
#include "src/app/commands.h"
#include "src/scene/scene.h"

#include <cstdio>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {

void addStill(CLI::App& app, Action& action) {
  struct Arguments {
    std::filesystem::path scene;
    std::filesystem::path out;
    RenderOptions options;
    std::optional<double> at;
    std::optional<int> strobe;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb =
      *app.add_subcommand("still", "Draw one moment of a scene, or several in one picture, as a PNG");
  verb.add_option("SCENE", arguments->scene, "the scene file (TOML)")->required();
  verb.add_option("-o,--output", arguments->out, "the PNG to write")->required()->type_name("X.png");
  addNumber(verb, "--at", arguments->at, "S", "the moment in seconds of the video: the frame on show then",
            0.0)
      ->required();
  addNumber(verb, "--strobe", arguments->strobe, "N",
            "draw this many equally spaced moments from 0 to --at, later ones on top", 1, kMaxStrobe);
  addSizeOption(verb, arguments->options);
  addSceneOptions(verb, arguments->options);
  addStrictOption(verb, arguments->options.strict);
  verb.callback([arguments, &action] {
    action = [arguments] {
      if (lowerCaseEnding(arguments->out) != ".png")
        throw Error(ExitCode::BadInput,
                    fmt::format("{}: a still is a PNG; end its name in .png", arguments->out.string()));
      const RenderOptions& options = arguments->options;
      const Scene scene = loadScene(arguments->scene, options.sceneOverrides());
      requireApart({"-o", arguments->out}, scene);
      const Viewport viewport = options.viewport(scene.size[0], scene.size[1], scene.scale);
      WarningLog warnings(options.strict ? WarningLog::Mode::Strict : WarningLog::Mode::Tell);
      SceneSource source(scene, viewport);
      source.watch(scene, warnings);
      AtomicFile file(arguments->out);
      const Still still =
          drawStill(source, arguments->at.value(), arguments->strobe.value_or(1), options.fps);
      const std::vector<std::uint8_t> png =
          encodePng(still.frame, still.alpha, printResolution(viewport.scale));
      file.write(png.data(), png.size());
      file.commit();
      const Snapshot shown = source.snapshot();
      say(stdout, fmt::format("{}: {}x{}, frame {} at {} s\n", arguments->out.string(), still.frame.width,
                              still.frame.height, shown.frame, shown.time));
      return static_cast<int>(ExitCode::Done);
    };
  });
}

} // namespace offstage
