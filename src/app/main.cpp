#include "render/job/command_line.h"
#include "render/job/interrupt.h"
#include "src/app/commands.h"

#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
  offstage::installSignalHandlers();
  CLI::App app("Renders 2D real-time-physics exercises without a screen.", "offstage");
  app.set_version_flag("--version", "offstage " OFFSTAGE_VERSION);
  app.require_subcommand(1);
  app.footer("Exit status: 0 done, 1 a comparison differs, 2 bad usage or input, 3 the environment lacks "
             "something,\n"
             "75 transient (retrying may help), 130 interrupted.");

  offstage::Action action;
  offstage::addRender(app, action);
  offstage::addStill(app, action);
  offstage::addTrace(app, action);
  offstage::addCheck(app, action);
  offstage::addDoctor(app, action);
  return offstage::runCommandLine(app, argc, argv, [&] { return action(); });
}
