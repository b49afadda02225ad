#include "render/stage/exercise.h"

#include "render/job/command_line.h"
#include "render/job/interrupt.h"
#include "render/job/poster.h"
#include "render/job/rehearsal.h"
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
    if (options.strict) {
      WarningLog strict(WarningLog::Mode::Strict);
      StageSource source(make(), options);
      source.watch(strict);
      rehearse(source, options, std::nullopt);
    }
    WarningLog warnings;
    std::optional<Poster> poster;
    if (!options.poster.empty()) poster.emplace(options.poster);
    if (!options.out.empty() || !options.hashFile.empty()) {
      StageSource source(make(), options);
      source.watch(warnings);
      printSummary(render(source, options), options);
    }
    if (poster) {
      StageSource source(make(), options); // at frame 0
      source.watch(warnings);
      poster->write(source, options, std::nullopt, options.scale.value_or(1.0));
    }
    return static_cast<int>(ExitCode::Done);
  });
}

} // namespace offstage
