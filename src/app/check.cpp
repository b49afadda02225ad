#include "render/compare/ignore.h"
#include "render/job/frame_maker.h"
#include "render/job/scene_source.h"
#include "render/output/json_text.h"
#include "src/app/commands.h"
#include "src/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {
namespace {

struct Findings {
  std::vector<Diagnostic> problems;
  ExitCode code = ExitCode::Done;
};

/// Everything that a render would refuse before its first frame: the scene's own errors, then its images',
/// then what the machine lacks for it.
Findings findingsOf(const std::filesystem::path& file) {
  try {
    const Scene scene = loadScene(file);
    const SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], scene.scale));
    if (scene.golden) {
      const Picture picture = pictureOf(source);
      static_cast<void>(ignoredPixels(scene.golden->tolerance, picture.width, picture.height));
    }
    return {};
  } catch (const SceneError& error) {
    return {error.diagnostics(), ExitCode::BadInput};
  } catch (const Error& error) {
    if (error.code() != ExitCode::BadInput && error.code() != ExitCode::Environment) throw;
    return {SceneError(file.string(), error.what()).diagnostics(), error.code()};
  }
}

void printJson(const std::filesystem::path& file, const std::vector<Diagnostic>& problems, bool first) {
  fmt::print("{}\n  {{\"file\": {}, \"ok\": {}, \"errors\": [", first ? "[" : ",", jsonText(file.string()),
             problems.empty());
  const char* separator = "";
  for (const Diagnostic& problem : problems) {
    fmt::print("{}\n    {{\"file\": {}, \"line\": {}, \"column\": {}, \"message\": {}}}", separator,
               jsonText(problem.where.file), problem.where.line, problem.where.column,
               jsonText(problem.message));
    separator = ",";
  }
  fmt::print("{}]}}", problems.empty() ? "" : "\n  ");
}

} // namespace

void addCheck(CLI::App& app, Action& action) {
  struct Arguments {
    std::vector<std::filesystem::path> scenes;
    bool json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb = *app.add_subcommand("check", "Validate scenes and the files they name; run nothing");
  verb.add_option("SCENE", arguments->scenes, "scene files (TOML)")->required();
  verb.add_flag("--json", arguments->json, "print the result as JSON");
  verb.callback([arguments, &action] {
    action = [arguments] {
      ExitCode worst = ExitCode::Done;
      for (std::size_t i = 0; i < arguments->scenes.size(); ++i) {
        const std::filesystem::path& file = arguments->scenes[i];
        const auto [problems, code] = findingsOf(file);
        if (code != ExitCode::Done && worst != ExitCode::BadInput)
          worst = code; // what is wrong before what lacks
        if (arguments->json) {
          printJson(file, problems, i == 0);
        } else if (problems.empty()) {
          fmt::print("{}: ok\n", file.string());
        } else {
          for (const Diagnostic& problem : problems) fmt::print(stderr, "{}\n", problem.text());
        }
      }
      if (arguments->json) fmt::print("\n]\n");
      return static_cast<int>(worst);
    };
  });
}

} // namespace offstage
