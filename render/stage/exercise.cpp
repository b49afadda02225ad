#include "render/stage/exercise.h"

#include "render/job/command_line.h"
#include "render/job/interrupt.h"
#include "render/job/poster.h"
#include "render/job/render_job.h"
#include "render/stage/stage_source.h"

#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {

int runExercise(const std::function<std::unique_ptr<Exercise>()>& make, int argc, const char* const* argv) {
  installSignalHandlers();
  CLI::App app("Renders this exercise to a video, pictures or a pipe.");
  RenderOptions options;
  addRenderOptions(app, options);
  return runCommandLine(app, argc, argv, [&] {
    requireOutput(options);
    std::optional<Poster> poster;
    if (!options.poster.empty()) poster.emplace(options.poster);
    if (!options.out.empty() || !options.hashFile.empty()) {
      StageSource source(make(), options);
      printSummary(render(source, options), options);
    }
    if (poster) {
      StageSource source(make(), options); // at frame 0
      poster->write(source, std::nullopt, options.scale.value_or(1.0));
    }
    return static_cast<int>(ExitCode::Done);
  });
}

} // namespace offstage
