#include "render/job/command_line.h"

#include "render/job/number_option.h"
#include "src/scene/diagnostic.h"

#include <charconv>
#include <cstdio>
#include <exception>
#include <new>

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

} // namespace

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
  addNumber(app, "--seed", options.seed, "N", "seed of the random numbers");
  addNumber(app, "--scale", options.scale, "F", "output pixels per scene pixel");
}

void addSizeOption(CLI::App& app, RenderOptions& options) {
  app.add_option_function<std::string>(
         "--size", [&options](const std::string& text) { options.size = parseSize(text); },
         "output size in pixels: the pane as large as fits, centred")
      ->type_name("WxH");
}

void addRenderOptions(CLI::App& app, RenderOptions& options) {
  app.add_option("-o,--output", options.out,
                 "what to make; the ending chooses: .mp4 .mkv .mov, a pattern such as frames/%06d.png, .raw, "
                 "or - for a pipe")
      ->type_name("OUT");
  addSizeOption(app, options);
  addSceneOptions(app, options);
  addNumber(app, "--from", options.from, "S", "first simulated second to show");
  addNumber(app, "--to", options.to, "S", "simulated second at which to end");
  app.add_option_function<std::string>(
         "--progress", [&options](const std::string& text) { options.progress = parseProgress(text); },
         "auto (a bar on a terminal), json (a line each), none")
      ->type_name("MODE");
  app.add_option("--hash", options.hashFile, "write a line a frame: frame state-hash pixel-hash")
      ->type_name("FILE");
}

int runCommandLine(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& action) {
  const auto status = [](ExitCode code) { return static_cast<int>(code); };
  try {
    app.parse(argc, argv);
    return action();
  } catch (const CLI::Success& help) {
    app.exit(help); // --help and --version go to stdout
    return status(ExitCode::Done);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "offstage: error: {}\nRun with --help for more information.\n", error.what());
    return status(ExitCode::BadInput);
  } catch (const SceneError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return status(error.code());
  } catch (const Error& error) {
    fmt::print(stderr, "offstage: error: {}\n", error.what());
    return status(error.code());
  } catch (const std::bad_alloc&) {
    std::fputs("offstage: error: out of memory\n", stderr);
    return status(ExitCode::Transient);
  } catch (const std::exception& error) {
    fmt::print(stderr, "offstage: error: {}\n", error.what());
    return status(ExitCode::BadInput);
  }
}

} // namespace offstage
