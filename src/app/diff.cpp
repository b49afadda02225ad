#include "render/compare/compare_files.h"
#include "render/compare/trace_report.h"
#include "render/job/number_option.h"
#include "render/job/output_places.h"
#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/png.h"
#include "src/app/commands.h"
#include "src/app/junit_option.h"
#include "src/app/tolerance_options.h"
#include "src/app/trace_options.h"

#include <cerrno>
#include <iostream>
#include <memory>
#include <utility>

namespace offstage {
namespace {

struct Arguments {
  std::filesystem::path expected;
  std::filesystem::path actual;
  ToleranceOptions tolerance;
  TraceOptions trace;
  std::string metric = "fast";
  std::optional<std::int64_t> maxPixels;
  std::optional<double> fps;
  bool json = false;
  std::filesystem::path junit;
  std::filesystem::path html;
  std::filesystem::path strip;
};

CompareResult compare(const Arguments& arguments, const CLI::App& verb) {
  const InputKind expected = inputKind(arguments.expected);
  const InputKind actual = inputKind(arguments.actual);
  const bool traces = expected == InputKind::Trace && actual == InputKind::Trace;
  requireFittingOptions(verb, traces);
  if (traces)
    return compareTraceFiles(arguments.expected, arguments.actual, arguments.trace.tolerance(),
                             arguments.trace.match);
  if (expected == InputKind::Trace || actual == InputKind::Trace)
    throw Error(ExitCode::BadInput, fmt::format("'{}' and '{}' are of different kinds: a trace, and pictures",
                                                arguments.expected.string(), arguments.actual.string()));
  const bool folder = std::filesystem::is_directory(arguments.expected);
  CompareOptions options;
  options.tolerance = arguments.tolerance.in(folder ? arguments.expected : arguments.expected.parent_path());
  options.metrics = arguments.metric == "all" ? Metrics::All : Metrics::Fast;
  options.maxPixels = arguments.maxPixels.value_or(kDefaultMaxPixels);
  options.pictures = !arguments.html.empty();
  options.strip = !arguments.strip.empty();
  options.fps = arguments.fps;

  // The one place where the kind of input chooses the comparison.
  if (expected == InputKind::Picture && actual == InputKind::Picture)
    return comparePictures(arguments.expected, arguments.actual, options);
  if (expected != InputKind::Picture && actual != InputKind::Picture)
    return compareSequences(arguments.expected, arguments.actual, options);
  throw Error(ExitCode::BadInput, fmt::format("'{}' and '{}' are of different kinds: one picture, and many",
                                              arguments.expected.string(), arguments.actual.string()));
}

void writePng(const std::filesystem::path& path, const Frame& frame) {
  AtomicFile file(path);
  const std::vector<std::uint8_t> png = encodePng(frame, false);
  file.write(png.data(), png.size());
  file.commit();
}

/// Throws Error(BadInput) when what is written would replace, or come to stand among, what is compared.
void requireOutside(const OutputPlace& output, const Arguments& arguments) {
  for (const auto& [what, input] :
       {std::pair{"EXPECTED", arguments.expected}, {"ACTUAL", arguments.actual}}) {
    requireApart(output, what, input);
    if (inputKind(input) != InputKind::Sequence) continue;
    if (!std::filesystem::is_directory(input))
      requireApart({what, input, true}, output.option, output.out);
    else if (output.out.extension() == ".png" && placeOf(output.out).parent_path() == placeOf(input))
      throw Error(ExitCode::BadInput, fmt::format("{} {} cannot be among the pictures of {}", output.option,
                                                  quoted(output.out), what));
  }
  if (arguments.tolerance.file) requireApart(output, "--tolerance", *arguments.tolerance.file);
  for (const std::filesystem::path& mask : arguments.tolerance.given.masks)
    requireApart(output, "--mask", mask);
}

int run(const Arguments& arguments, const CLI::App& verb) {
  // Before a long comparison.
  if (!arguments.strip.empty() && arguments.strip.extension() != ".png")
    throw Error(ExitCode::BadInput,
                fmt::format("--strip '{}' is a PNG; end its name in .png", arguments.strip.string()));
  const OutputPlace strip{"--strip", arguments.strip};
  const OutputPlace junit{"--junit", arguments.junit};
  requireApart(strip, junit.option, junit.out);
  for (const OutputPlace& output : {strip, junit}) {
    if (output.out.empty()) continue;
    requireOutside(output, arguments);
    requireWritable(output.out);
  }
  const std::string title =
      fmt::format("offstage diff {} {}", arguments.expected.string(), arguments.actual.string());
  const CompareResult result = withJunit(arguments.junit, "offstage.diff", title, [&] {
    if (!arguments.html.empty()) requireReportFolder(arguments.html);
    CompareResult compared = compare(arguments, verb);
    if (compared.strip) writePng(arguments.strip, *compared.strip);
    return compared;
  });
  if (!arguments.junit.empty()) writeJunit(arguments.junit, result.report);
  if (!arguments.html.empty()) writeHtml(arguments.html, result.report);
  if (arguments.json)
    writeJson(std::cout, result.report);
  else
    writeText(std::cout, result.report);
  std::cout.flush();
  if (!std::cout) throw standardOutputError(errno);
  return static_cast<int>(result.report.passed ? ExitCode::Done : ExitCode::Differs);
}

} // namespace

void addDiff(CLI::App& app, Action& action) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& verb = *app.add_subcommand(
      "diff", "Compare pictures, frame sequences, videos or traces: exit status 0 same, 1 different");
  verb.add_option("EXPECTED", arguments->expected,
                  "a picture (PNG, JPEG, BMP), a folder, a pattern such as frames/%06d.png, a video, or a "
                  "trace (.csv)")
      ->required();
  verb.add_option("ACTUAL", arguments->actual, "what is held against it")->required();
  verb.add_flag("--json", arguments->json, "print the result as JSON");
  verb.add_option("--junit", arguments->junit, "write the result as JUnit's XML")->type_name("FILE");
  verb.add_option("--html", arguments->html, "write a report that opens in a browser")->type_name("DIR");
  verb.add_option("--strip", arguments->strip,
                  "write expected | difference | actual as one picture; of a sequence its worst frame")
      ->type_name("X.png");
  verb.add_option("--metric", arguments->metric,
                  "fast (default): what counting finds; all: SSIM, pixelmatch's counts and FLIP too")
      ->check(CLI::IsMember({"fast", "all"}))
      ->type_name("WHICH");
  addNumber(verb, "--max-pixels", arguments->maxPixels, "N",
            "refuse pictures of more pixels (default 268435456; how many may differ is --max-differing)",
            std::int64_t{1}, std::int64_t{1} << 40);
  addNumber(verb, "--fps", arguments->fps, "N", "frames a second of folders and patterns, for times", 1e-3,
            1e6);
  addToleranceOptions(verb, arguments->tolerance);
  addTraceOptions(verb, arguments->trace);
  verb.callback(
      [arguments, &action, &verb] { action = [arguments, &verb] { return run(*arguments, verb); }; });
}

} // namespace offstage
