#include "render/job/command_line.h"
#include "render/job/interrupt.h"
#include "src/app/commands.h"
#include "src/scene/nearest.h"
#include "src/sim/error.h"

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace {

/// CLI11 says of an unknown verb only that one is required.
void requireKnownVerb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> verbs;
  std::string list;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == argv[1]) return;
    verbs.emplace_back(verb->get_name());
    list += (list.empty() ? "" : ", ") + verb->get_name();
  }
  const std::vector<std::string_view> words(verbs.begin(), verbs.end());
  const std::string_view near = offstage::nearest(argv[1], words);
  throw offstage::Error(offstage::ExitCode::BadInput,
                        near.empty() ? fmt::format("unknown verb '{}'; there are {}", argv[1], list)
                                     : fmt::format("unknown verb '{}'; did you mean '{}'?", argv[1], near));
}

} // namespace

int main(int argc, char** argv) {
  offstage::installSignalHandlers();
  CLI::App app("Renders 2D real-time-physics exercises without a screen.", "offstage");
  app.set_version_flag("--version", "offstage " OFFSTAGE_VERSION);
  app.require_subcommand(1);
  app.preparse_callback([&](std::size_t) { requireKnownVerb(app, argc, argv); });
  app.footer("Exit status: 0 done, 1 a comparison differs, 2 bad usage or input, 3 the environment lacks "
             "something,\n"
             "75 transient (retrying may help), 130 interrupted.");

  offstage::Action action;
  offstage::addRender(app, action);
  offstage::addJoin(app, action);
  offstage::addStill(app, action);
  offstage::addBundle(app, action);
  offstage::addTrace(app, action);
  offstage::addDiff(app, action);
  offstage::addGolden(app, action);
  offstage::addCheck(app, action);
  offstage::addDoctor(app, action);
  return offstage::runCommandLine(app, argc, argv, [&] { return action(); });
}
