#include "src/scene/trace.h"

#include "render/job/command_line.h"
#include "render/job/interrupt.h"
#include "render/job/output_places.h"
#include "render/job/warning_log.h"
#include "render/output/text_output.h"
#include "src/app/commands.h"
#include "src/scene/scene.h"
#include "src/scene/trace_summary.h"
#include "src/sim/world.h"

#include <iostream>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {
namespace {

TraceFormat formatOf(const std::filesystem::path& out) {
  if (out == "-" || out.extension() == ".csv") return TraceFormat::Csv;
  if (out.extension() == ".jsonl") return TraceFormat::JsonLines;
  throw Error(ExitCode::BadInput,
              fmt::format("{}: a trace ends in .csv or .jsonl, or is - for a pipe", out.string()));
}

/// Runs the scene to its end, `take` seeing every frame, the first included.
template <typename Take>
void runAll(const Scene& scene, WarningLog& warnings, const Take& take) {
  World world(scene.world);
  WatchedRun run(world, WarningText(scene), warnings);
  take(world);
  while (world.frame() < scene.clock.steps()) {
    throwIfInterrupted();
    run.step(world, scene.clock.tick(world.frame() + 1));
    take(world);
  }
}

} // namespace

void addTrace(CLI::App& app, Action& action) {
  struct Arguments {
    std::filesystem::path scene;
    std::filesystem::path out = "-";
    std::filesystem::path events;
    bool summary = false;
    RenderOptions options;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb =
      *app.add_subcommand("trace", "Write the state of every body in every frame, without drawing");
  verb.add_option("SCENE", arguments->scene, "the scene file (TOML)")->required();
  verb.add_option("-o,--output", arguments->out, "the trace: .csv, .jsonl, or - for CSV to a pipe (default)")
      ->type_name("X.csv");
  verb.add_option("--events", arguments->events, "bounces, hits, spawns and removals: .csv, .jsonl or -")
      ->type_name("FILE");
  verb.add_flag(
      "--summary", arguments->summary,
      "print what the run comes to: momentum, energy and its drift (but for frames in which bodies come or "
      "go), contacts, the largest overlap; the trace itself is then only written where -o is given");
  addSceneOptions(verb, arguments->options);
  addStrictOption(verb, arguments->options.strict);
  verb.callback([arguments, &action, &verb] {
    const bool withTrace = !arguments->summary || verb.count("--output") > 0;
    action = [arguments, withTrace] {
      const TraceFormat format = withTrace ? formatOf(arguments->out) : TraceFormat::Csv;
      const bool withEvents = !arguments->events.empty();
      const TraceFormat eventFormat = withEvents ? formatOf(arguments->events) : TraceFormat::Csv;
      if (withEvents && arguments->events == arguments->out)
        throw Error(ExitCode::BadInput, "the trace and its events cannot go to the same place");
      if (arguments->summary && ((withTrace && arguments->out == "-") || arguments->events == "-"))
        throw Error(ExitCode::BadInput,
                    "the summary goes to the standard output, so the trace and its events cannot");
      const OutputPlace trace{"-o", withTrace ? arguments->out : ""};
      const OutputPlace ofEvents{"--events", arguments->events};
      requireApart(trace, ofEvents.option, ofEvents.out);
      const Scene scene = loadScene(arguments->scene, arguments->options.sceneOverrides());
      requireApart(trace, scene);
      requireApart(ofEvents, scene);
      if (scene.replay)
        throw Error(ExitCode::BadInput, fmt::format("{} simulates nothing: it replays the trace {}",
                                                    arguments->scene.string(), scene.replay->trace.file));
      if (arguments->options.fps && !scene.clock.isFixed())
        throw Error(ExitCode::BadInput,
                    "--fps: a trace has a row for every step, and those of a recorded clock are "
                    "recorded; leave it out");
      if (arguments->options.strict) { // what is written to a pipe cannot be taken back
        WarningLog strict(WarningLog::Mode::Strict);
        runAll(scene, strict, [](const World&) {});
      }
      std::optional<TextOutput> states;
      if (withTrace) states.emplace(arguments->out);
      std::optional<TextOutput> events;
      if (withEvents) events.emplace(arguments->events);
      std::optional<TraceWriter> stateWriter;
      if (states) stateWriter.emplace(states->stream(), format, scene.world.groups);
      std::optional<EventWriter> eventWriter;
      if (events) eventWriter.emplace(events->stream(), eventFormat);

      std::optional<TraceSummary> summary;
      if (arguments->summary) summary.emplace(scene.world);

      WarningLog warnings;
      runAll(scene, warnings, [&](const World& world) {
        if (stateWriter) stateWriter->write(world);
        if (eventWriter) eventWriter->write(world);
        if (summary) summary->add(world);
      });
      if (states) states->commit();
      if (events) events->commit();
      if (summary) fmt::print("{}", summary->text());
      return static_cast<int>(ExitCode::Done);
    };
  });
}

} // namespace offstage
