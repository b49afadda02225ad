#include "render/stage/exercise.h"

#include "render/job/command_line.h"
#include "render/job/interrupt.h"
#include "render/job/render_job.h"
#include "render/stage/stage_source.h"

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
    StageSource source(make(), options);
    const RenderResult result = render(source, options);
    printSummary(result, options);
    return static_cast<int>(ExitCode::Done);
  });
}

} // namespace offstage
