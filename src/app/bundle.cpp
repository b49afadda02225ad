#include "render/job/bundle.h"

#include "render/job/command_line.h"
#include "render/job/console.h"
#include "src/app/commands.h"
#include "src/scene/scene.h"

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {

void addBundle(CLI::App& app, Action& action) {
  struct Arguments {
    std::filesystem::path scene;
    RenderOptions options;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb = *app.add_subcommand("bundle", "Make a folder with a scene's videos, captions, chapters, "
                                                 "poster, GIF, trace and a page that plays them");
  verb.add_option("SCENE", arguments->scene, "the scene file (TOML)")->required();
  verb.add_option("-o,--output", arguments->options.out,
                  "the folder to make; one that offstage made before and nobody has changed is replaced")
      ->required()
      ->type_name("DIR");
  addDrawingOptions(verb, arguments->options);
  addStrictOption(verb, arguments->options.strict);
  addWorkerOptions(verb, arguments->options);
  verb.callback([arguments, &action] {
    action = [arguments] {
      const RenderOptions& options = arguments->options;
      const Scene scene = loadScene(arguments->scene, options.sceneOverrides());
      for (const std::string& name : makeBundle(scene, options))
        say(stdout, (options.out / name).string() + "\n");
      return static_cast<int>(ExitCode::Done);
    };
  });
}

} // namespace offstage
