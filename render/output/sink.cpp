#include "render/output/sink.h"

#include "render/output/file_error.h"
#include "render/output/png_sequence.h"
#include "render/output/raw_sink.h"
#include "render/output/video_sink.h"
#include "src/sim/error.h"

#include <algorithm>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {

namespace {

constexpr const char* kEndings = ".mp4, .mkv, .mov (H.264 video), a pattern such as frames/%06d.png, .raw "
                                 "(RGBA bytes), or - (RGBA bytes to standard "
                                 "output)";

std::string lowerCaseEnding(const std::filesystem::path& out) {
  std::string ending = out.extension().native();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

void requireSize(const SinkFormat& format) {
  if (format.width >= 1 && format.height >= 1) return;
  throw Error(ExitCode::BadInput,
              fmt::format("a picture of {} × {} px cannot be written", format.width, format.height));
}

/// "x.png" for "x-%06d.png": what the user has probably meant.
std::string numbered(std::filesystem::path out) {
  out.replace_filename(out.stem().native() + "-%06d" + out.extension().native());
  return out.native();
}

} // namespace

std::unique_ptr<Sink> makeSink(const std::filesystem::path& out, const SinkFormat& format) {
  requireSize(format);
  if (out == "-") return std::make_unique<RawPipeSink>(STDOUT_FILENO, format);
  const std::string ending = lowerCaseEnding(out);
  if (ending == ".mp4") return std::make_unique<VideoSink>(out, Container::Mp4, format);
  if (ending == ".mov") return std::make_unique<VideoSink>(out, Container::Mov, format);
  if (ending == ".mkv") return std::make_unique<VideoSink>(out, Container::Matroska, format);
  if (ending == ".raw") return std::make_unique<RawFileSink>(out, format);
  if (ending == ".png") {
    if (out.filename().native().find('%') == std::string::npos) {
      throw Error(ExitCode::BadInput,
                  fmt::format("{} names one picture: write '{}' for a file a frame, or use `offstage still` "
                              "for a single frame",
                              quoted(out), numbered(out)));
    }
    return std::make_unique<PngSequenceSink>(out, format);
  }
  if (ending.empty()) {
    throw Error(ExitCode::BadInput,
                fmt::format("the name {} has no ending that tells what to write: {}", quoted(out), kEndings));
  }
  throw Error(ExitCode::BadInput,
              fmt::format("cannot write {} files ({}); there are {}", ending, quoted(out), kEndings));
}

} // namespace offstage
