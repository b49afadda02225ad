#include "render/job/still.h"

#include "render/job/command_line.h"
#include "render/job/console.h"
#include "render/job/poster.h"
#include "render/output/atomic_file.h"
#include "render/output/png.h"
#include "src/app/commands.h"
#include "src/scene/scene.h"

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {

void addStill(CLI::App& app, Action& action) {
  struct Arguments {
    std::filesystem::path scene;
    std::filesystem::path out;
    RenderOptions options;
    double at = 0.0;
    int strobe = 1;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb =
      *app.add_subcommand("still", "Draw one moment of a scene, or several in one picture, as a PNG");
  verb.add_option("SCENE", arguments->scene, "the scene file (TOML)")->required();
  verb.add_option("-o,--output", arguments->out, "the PNG to write")->required()->type_name("X.png");
  verb.add_option("--at", arguments->at, "the moment in seconds of the video: the frame on show then")
      ->required()
      ->check(CLI::NonNegativeNumber)
      ->type_name("S");
  verb.add_option("--strobe", arguments->strobe,
                  "draw this many equally spaced moments from 0 to --at, later ones on top")
      ->check(CLI::Range(1, kMaxStrobe))
      ->type_name("N");
  addSizeOption(verb, arguments->options);
  addSceneOptions(verb, arguments->options);
  addStrictOption(verb, arguments->options.strict);
  verb.callback([arguments, &action] {
    action = [arguments] {
      if (arguments->out.extension() != ".png")
        throw Error(ExitCode::BadInput,
                    fmt::format("{}: a still is a PNG; end its name in .png", arguments->out.string()));
      const RenderOptions& options = arguments->options;
      const Scene scene = loadScene(arguments->scene, options.sceneOverrides());
      const Viewport viewport = options.viewport(scene.size[0], scene.size[1], scene.scale);
      WarningLog warnings(options.strict ? WarningLog::Mode::Strict : WarningLog::Mode::Tell);
      SceneSource source(scene, viewport);
      source.watch(scene, warnings);
      AtomicFile file(arguments->out);
      const Still still = drawStill(source, arguments->at, arguments->strobe);
      const std::vector<std::uint8_t> png =
          encodePng(still.frame, still.alpha, printResolution(viewport.scale));
      file.write(png.data(), png.size());
      file.commit();
      say(stdout, fmt::format("{}: {}x{}, frame {} at {} s\n", arguments->out.string(), still.frame.width,
                              still.frame.height, source.frame(), source.time()));
      return static_cast<int>(ExitCode::Done);
    };
  });
}

} // namespace offstage
