#include "render/job/chunked_render.h"
#include "render/job/command_line.h"
#include "render/job/render_job.h"
#include "render/job/scene_source.h"
#include "src/app/commands.h"
#include "src/scene/scene.h"
#include "src/sim/error.h"

#include <memory>

#include <CLI/CLI.hpp>

namespace offstage {

void addJoin(CLI::App& app, Action& action) {
  struct Arguments {
    std::filesystem::path scene;
    RenderOptions options;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb = *app.add_subcommand(
      "join", "Join the segments of `render --segment I/N` without encoding anything again");
  verb.add_option("SCENE", arguments->scene, "the scene file (TOML) that the segments show")->required();
  addJoinOptions(verb, arguments->options);
  verb.callback([arguments, &action] {
    action = [arguments] {
      if (arguments->options.out.empty()) throw Error(ExitCode::BadInput, "give -o OUT, as to the segments");
      const RenderOptions options = optionsOfSegments(arguments->options);
      requireOutput(options);
      const Scene scene = loadScene(arguments->scene, options.sceneOverrides());
      requireApart(options, scene);
      SceneSource source(scene, options.viewport(scene.size[0], scene.size[1], scene.scale));
      printSummary(joinSegments(source, options), options);
      return static_cast<int>(ExitCode::Done);
    };
  });
}

} // namespace offstage
