#include "src/scene/trace.h"

#include "render/job/command_line.h"
#include "render/job/interrupt.h"
#include "render/output/text_output.h"
#include "src/app/commands.h"
#include "src/scene/scene.h"
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

} // namespace

void addTrace(CLI::App& app, Action& action) {
  struct Arguments {
    std::filesystem::path scene;
    std::filesystem::path out = "-";
    std::filesystem::path events;
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
  addSceneOptions(verb, arguments->options);
  verb.callback([arguments, &action] {
    action = [arguments] {
      const TraceFormat format = formatOf(arguments->out);
      const bool withEvents = !arguments->events.empty();
      const TraceFormat eventFormat = withEvents ? formatOf(arguments->events) : TraceFormat::Csv;
      if (withEvents && arguments->events == arguments->out)
        throw Error(ExitCode::BadInput, "the trace and its events cannot go to the same place");
      const Scene scene = loadScene(arguments->scene, arguments->options.sceneOverrides());

      if (scene.replay)
        throw Error(ExitCode::BadInput, fmt::format("{} simulates nothing: it replays the trace {}",
                                                    arguments->scene.string(), scene.replay->trace.file));
      TextOutput states(arguments->out);
      std::optional<TextOutput> events;
      if (withEvents) events.emplace(arguments->events);
      TraceWriter stateWriter(states.stream(), format, scene.world.groups);
      std::optional<EventWriter> eventWriter;
      if (events) eventWriter.emplace(events->stream(), eventFormat);

      World world(scene.world);
      stateWriter.write(world);
      while (world.frame() < scene.clock.steps()) {
        throwIfInterrupted();
        world.step(scene.clock.tick(world.frame() + 1));
        stateWriter.write(world);
        if (eventWriter) eventWriter->write(world);
      }
      states.commit();
      if (events) events->commit();
      return static_cast<int>(ExitCode::Done);
    };
  });
}

} // namespace offstage
