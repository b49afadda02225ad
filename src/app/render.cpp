#include "render/job/command_line.h"
#include "render/job/poster.h"
#include "render/job/rehearsal.h"
#include "render/job/render_job.h"
#include "render/job/scene_source.h"
#include "src/app/commands.h"
#include "src/app/preload.h"
#include "src/scene/scene.h"

#include <future>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

namespace offstage {

void addRender(CLI::App& app, Action& action) {
  struct Arguments {
    std::filesystem::path scene;
    RenderOptions options;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb = *app.add_subcommand("render", "Render a scene to a video, to PNGs or to a pipe");
  verb.add_option("SCENE", arguments->scene, "the scene file (TOML)")->required();
  addRenderOptions(verb, arguments->options);
  verb.callback([arguments, &action] {
    action = [arguments] {
      const RenderOptions& options = arguments->options;
      requireOutput(options);
      const std::future<void> libraries = preloadLibraries(options.out);
      const Scene scene = loadScene(arguments->scene, options.sceneOverrides());
      libraries.wait();
      requireApart(options, scene);
      const Viewport viewport = options.viewport(scene.size[0], scene.size[1], scene.scale);
      if (options.strict) {
        WarningLog strict(WarningLog::Mode::Strict);
        SceneSource source(scene, viewport);
        source.watch(scene, strict);
        rehearse(source, options, scene.timeline.poster);
      }
      WarningLog warnings;
      std::optional<Poster> poster;
      if (!options.poster.empty()) poster.emplace(options.poster);
      if (!options.out.empty() || !options.hashFile.empty()) {
        SceneSource source(scene, viewport);
        source.watch(scene, warnings);
        if (poster) poster->requireFit(source);
        printSummary(render(source, options), options);
      }
      if (poster) {
        SceneSource source(scene, viewport); // at frame 0
        source.watch(scene, warnings);
        poster->write(source, options, scene.timeline.poster, viewport.scale);
      }
      return static_cast<int>(ExitCode::Done);
    };
  });
}

} // namespace offstage
