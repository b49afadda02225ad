#include "render/job/command_line.h"

#include "render/job/console.h"
#include "render/job/number_option.h"
#include "render/output/file_error.h"
#include "src/scene/diagnostic.h"

#include <charconv>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {
namespace {

ProgressMode parseProgress(const std::string& text) {
  if (text == "auto") return ProgressMode::Auto;
  if (text == "json") return ProgressMode::Json;
  if (text == "none") return ProgressMode::None;
  throw Error(ExitCode::BadInput, fmt::format("--progress '{}' is not auto, json or none", text));
}

Quality parseQuality(const std::string& text) {
  if (const std::optional<Quality> quality = qualityOfName(text)) return *quality;
  throw Error(ExitCode::BadInput, fmt::format("--quality '{}' is not draft, good, high or lossless", text));
}

int parseJobs(const std::string& text) {
  int jobs = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), jobs);
  if (error == std::errc{} && end == text.data() + text.size() && jobs >= 0 && jobs <= kMostJobs) return jobs;
  throw Error(ExitCode::BadInput,
              fmt::format("--jobs '{}' is not a whole number from 0 to {}", text, kMostJobs));
}

} // namespace

Segment parseSegment(const std::string& text) {
  Segment segment;
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, segment.number);
  if (number.ec == std::errc{} && number.ptr != end && *number.ptr == '/') {
    const auto count = std::from_chars(number.ptr + 1, end, segment.count);
    if (count.ec == std::errc{} && count.ptr == end && segment.number >= 1 &&
        segment.number <= segment.count && segment.count <= kMostSegments)
      return segment;
  }
  throw Error(ExitCode::BadInput,
              fmt::format("--segment '{}' is not I/N, the I-th of N parts, with I from 1 to N (at most {})",
                          text, kMostSegments));
}

std::array<int, 2> parseSize(const std::string& text) {
  std::array<int, 2> size{};
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size[0]);
  if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size[1]);
    if (height.ec == std::errc{} && height.ptr == end && size[0] > 0 && size[1] > 0) return size;
  }
  throw Error(ExitCode::BadInput,
              fmt::format("--size '{}' is not a width and height in pixels such as 1920x1080", text));
}

void addSceneOptions(CLI::App& app, RenderOptions& options) {
  addNumber(app, "--fps", options.fps, "N", "frames a second of a fixed clock; resamples a recorded one");
  addNumber(app, "--duration", options.duration, "S", "simulated seconds");
  app.add_option("--dt", options.dtLog, "a dt log to step by: a frame duration in ns a line")
      ->type_name("LOG");
  app.add_option("--input", options.input, "recorded input to replay: keys and mouse, an event a line")
      ->type_name("LOG");
  addNumber(app, "--seed", options.seed, "N", "seed of the random numbers");
  addNumber(app, "--scale", options.scale, "F", "output pixels per scene pixel");
}

void addSizeOption(CLI::App& app, RenderOptions& options) {
  app.add_option_function<std::string>(
         "--size", [&options](const std::string& text) { options.size = parseSize(text); },
         "output size in pixels: the pane as large as fits, centred")
      ->type_name("WxH");
}

void addStrictOption(CLI::App& app, bool& strict) {
  app.add_flag("--strict", strict,
               "make nothing, with status 2, when the run has a warning: a body that is nowhere, energy from "
               "nowhere, a body that went through another, a step too long for a spring");
}

void addDrawingOptions(CLI::App& app, RenderOptions& options) {
  addSizeOption(app, options);
  addSceneOptions(app, options);
  addNumber(app, "--from", options.from, "S",
            "first second of the video to show (of simulated time, unless the scene changes it)");
  addNumber(app, "--to", options.to, "S", "second of the video at which to end");
  app.add_option_function<std::string>(
         "--quality", [&options](const std::string& text) { options.quality = parseQuality(text); },
         "draft, good (default), high; lossless with .mkv")
      ->type_name("WORD");
}

namespace {

void addOutputOption(CLI::App& app, RenderOptions& options) {
  app.add_option("-o,--output", options.out,
                 "what to make; the ending chooses: .mp4 .mkv .mov .webm .gif .apng, a pattern such as "
                 "frames/%06d.png, .raw, or - for a pipe")
      ->type_name("OUT");
}

void addJobsOption(CLI::App& app, RenderOptions& options) {
  app.add_option_function<std::string>(
         "--jobs", [&options](const std::string& text) { options.jobs = parseJobs(text); },
         "worker processes at a time (default: one a processor); 0: none, all in this process")
      ->type_name("N");
}

void addProgressOption(CLI::App& app, RenderOptions& options) {
  app.add_option_function<std::string>(
         "--progress", [&options](const std::string& text) { options.progress = parseProgress(text); },
         "auto (a bar on a terminal), json (a line each), none")
      ->type_name("MODE");
}

void addReportOptions(CLI::App& app, RenderOptions& options) {
  addProgressOption(app, options);
  app.add_option("--hash", options.hashFile,
                 "write a line a frame of the output: the simulated frame that it shows, its state hash, the "
                 "pixel hash")
      ->type_name("FILE");
}

} // namespace

void addWorkerOptions(CLI::App& app, RenderOptions& options) {
  addJobsOption(app, options);
  addProgressOption(app, options);
}

void addRenderOptions(CLI::App& app, RenderOptions& options) {
  addOutputOption(app, options);
  addDrawingOptions(app, options);
  addStrictOption(app, options.strict);
  addJobsOption(app, options);
  app.add_option_function<std::string>(
         "--segment", [&options](const std::string& text) { options.segment = parseSegment(text); },
         "render only the I-th of N parts, from 1 on; join them with `offstage join`")
      ->type_name("I/N");
  app.add_option(
         "--poster", options.poster,
         "also draw one moment, which stands for the video: that of the scene's [poster], else the middle")
      ->type_name("X.png|X.jpg");
  app.add_flag_callback(
      "--no-resume", [&options] { options.resume = false; }, "start over, whatever an earlier run has left");
  addReportOptions(app, options);
}

void addJoinOptions(CLI::App& app, RenderOptions& options) {
  addOutputOption(app, options);
  addDrawingOptions(app, options);
  addReportOptions(app, options);
}

RenderOptions parseRenderOptions(const std::vector<std::string>& arguments) {
  RenderOptions options;
  CLI::App app;
  addDrawingOptions(app, options);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend()); // as CLI11 takes them
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    throw Error(ExitCode::BadInput, fmt::format("bad options in a manifest: {}", error.what()));
  }
  return options;
}

int runCommandLine(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& action) {
  const auto fail = [](ExitCode code, const std::string& text) {
    say(stderr, text + "\n");
    return static_cast<int>(code);
  };
  const auto failWith = [&fail](ExitCode code, std::string_view why) {
    return fail(code, fmt::format("offstage: error: {}", why));
  };
  occupyStandardStreams();
  try {
    app.parse(argc, argv);
    const int status = action();
    if (status == static_cast<int>(ExitCode::Done)) requireResultsWritten();
    return status;
  } catch (const CLI::Success& help) {
    app.exit(help); // --help and --version go to stdout
    return static_cast<int>(ExitCode::Done);
  } catch (const CLI::ParseError& error) {
    return failWith(ExitCode::BadInput,
                    fmt::format("{}\nRun with --help for more information.", error.what()));
  } catch (const SceneError& error) {
    return fail(error.code(), error.what());
  } catch (const Error& error) {
    return failWith(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failWith(ExitCode::Transient, "out of memory");
  } catch (const std::system_error& error) {
    // {fmt} throws one where standard output takes no more.
    if (std::ferror(stdout) == 0) return failWith(ExitCode::BadInput, error.what());
    return failWith(ExitCode::Transient, standardOutputError(error.code().value()).what());
  } catch (const std::exception& error) {
    return failWith(ExitCode::BadInput, error.what());
  }
}

} // namespace offstage
