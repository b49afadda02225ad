#include "render/compare/golden_output.h"
#include "render/job/command_line.h"
#include "render/job/golden_job.h"
#include "render/job/output_places.h"
#include "src/app/commands.h"
#include "src/app/junit_option.h"
#include "src/sim/error.h"

#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {
namespace {

struct Arguments {
  std::filesystem::path goldens;
  std::filesystem::path scenes;
  std::filesystem::path out = kGoldenOut;
  std::filesystem::path junit;
  std::vector<std::string> names;
  bool json = false;
  bool strict = false;

  [[nodiscard]] GoldenFolders folders() const { return {goldens, scenes.empty() ? goldens : scenes, out}; }
  [[nodiscard]] WarningLog::Mode mode() const {
    return strict ? WarningLog::Mode::Strict : WarningLog::Mode::Tell;
  }
};

void addFolder(CLI::App& verb, Arguments& arguments) {
  verb.add_option("DIR", arguments.goldens, "the folder of the goldens")->required();
}

void addScenes(CLI::App& verb, Arguments& arguments) {
  verb.add_option("--scenes", arguments.scenes, "the folder of the scenes (default: DIR)")->type_name("DIR");
}

void addOut(CLI::App& verb, Arguments& arguments) {
  verb.add_option("--out", arguments.out, "what a verification leaves to look at (default: out/golden)")
      ->type_name("DIR");
}

int record(const Arguments& arguments) {
  const GoldenRecording recording = recordGoldens(arguments.folders(), arguments.mode());
  for (const std::string& name : recording.recorded) fmt::print("recorded {}\n", name);
  for (const std::string& name : recording.unchanged) fmt::print("unchanged {}\n", name);
  for (const std::string& name : recording.differing)
    fmt::print("differs {}: its golden stays; verify, look, and accept it\n", name);
  fmt::print("{} recorded, {} unchanged, {} differ\n", recording.recorded.size(), recording.unchanged.size(),
             recording.differing.size());
  return static_cast<int>(recording.differing.empty() ? ExitCode::Done : ExitCode::Differs);
}

/// Throws Error(BadInput) when the report would replace a file of the folders; an older report it may.
void requireApartFromFolders(const Arguments& arguments) {
  if (arguments.junit.empty()) return;
  const GoldenFolders folders = arguments.folders();
  for (const std::filesystem::path& folder : {folders.goldens, folders.scenes}) {
    std::error_code unreadable; // said by what reads it
    for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable))
      if (entry.path().extension() != ".xml")
        requireApart({"--junit", arguments.junit}, "a file of the goldens or scenes,", entry.path());
  }
}

int verify(const Arguments& arguments) {
  requireApartFromFolders(arguments);
  const Report report =
      withJunit(arguments.junit, "offstage.golden", "offstage golden verify " + arguments.goldens.string(),
                [&] { return verifyGoldens(arguments.folders(), arguments.mode()); });
  if (!arguments.junit.empty()) writeJunit(arguments.junit, report);
  if (arguments.json) {
    writeJson(std::cout, report);
  } else {
    writeText(std::cout, report);
    if (!report.passed) fmt::print("to look at: {}\n", (arguments.out / "report" / "index.html").string());
  }
  return static_cast<int>(report.passed ? ExitCode::Done : ExitCode::Differs);
}

int accept(const Arguments& arguments) {
  GoldenStore store(arguments.goldens);
  const std::vector<std::string> taken = acceptGoldens(store, arguments.out, arguments.names);
  for (const std::string& name : taken) fmt::print("accepted {}\n", name);
  fmt::print("{} accepted; verify says whether they hold\n", taken.size());
  return static_cast<int>(ExitCode::Done);
}

} // namespace

void addGolden(CLI::App& app, Action& action) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& golden = *app.add_subcommand("golden", "Keep pictures of scenes, and hold later ones to them");
  golden.require_subcommand(1);
  golden.footer("A scene says in [golden] which of its moments are kept.");

  CLI::App& recordVerb =
      *golden.add_subcommand("record", "Draw the goldens that are not there yet; others stay as they are");
  addFolder(recordVerb, *arguments);
  addScenes(recordVerb, *arguments);
  addStrictOption(recordVerb, arguments->strict);
  recordVerb.callback([arguments, &action] { action = [arguments] { return record(*arguments); }; });

  CLI::App& verifyVerb =
      *golden.add_subcommand("verify", "Draw every golden again: same, pixels changed, physics changed, …");
  addFolder(verifyVerb, *arguments);
  addScenes(verifyVerb, *arguments);
  addOut(verifyVerb, *arguments);
  addStrictOption(verifyVerb, arguments->strict);
  verifyVerb.add_flag("--json", arguments->json, "print the result as JSON");
  verifyVerb.add_option("--junit", arguments->junit, "write the result as JUnit's XML")->type_name("FILE");
  verifyVerb.callback([arguments, &action] { action = [arguments] { return verify(*arguments); }; });

  CLI::App& acceptVerb = *golden.add_subcommand(
      "accept", "Take over what the last verification drew: these names, or all that differed");
  addFolder(acceptVerb, *arguments);
  acceptVerb.add_option("NAME", arguments->names, "goldens, such as bounce@2.5s");
  addOut(acceptVerb, *arguments);
  acceptVerb.callback([arguments, &action] { action = [arguments] { return accept(*arguments); }; });
}

} // namespace offstage
