#include "render/output/output_kind.h"

#include "render/output/file_error.h"
#include "src/sim/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::array<std::pair<std::string_view, OutputKind>, 8> kEndings{{{".mp4", OutputKind::Mp4},
                                                                           {".mkv", OutputKind::Matroska},
                                                                           {".mov", OutputKind::Mov},
                                                                           {".webm", OutputKind::WebM},
                                                                           {".gif", OutputKind::Gif},
                                                                           {".apng", OutputKind::Apng},
                                                                           {".png", OutputKind::PngSequence},
                                                                           {".raw", OutputKind::RawFile}}};

constexpr const char* kList =
    ".mp4, .mkv, .mov, .webm, .gif, .apng, a pattern such as frames/%06d.png, .raw (RGBA "
    "bytes), or - (RGBA bytes to standard output)";

/// "x-%06d.png" for "x.png": what the user has probably meant.
std::string numbered(std::filesystem::path out) {
  out.replace_filename(out.stem().native() + "-%06d" + out.extension().native());
  return out.native();
}

} // namespace

std::string lowerCaseEnding(const std::filesystem::path& out) {
  std::string ending = out.extension().native();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

OutputKind outputKind(const std::filesystem::path& out) {
  if (out == "-") return OutputKind::RawPipe;
  if (!out.empty() && !out.has_filename()) throw fileError(EISDIR, out);
  const std::string ending = lowerCaseEnding(out);
  if (ending.empty()) {
    throw Error(ExitCode::BadInput,
                fmt::format("the name {} has no ending that tells what to write: {}", quoted(out), kList));
  }
  const auto* entry = std::ranges::find(kEndings, ending, &decltype(kEndings)::value_type::first);
  if (entry == kEndings.end()) {
    throw Error(ExitCode::BadInput,
                fmt::format("cannot write {} files ({}); there are {}", ending, quoted(out), kList));
  }
  if (entry->second == OutputKind::PngSequence && out.filename().native().find('%') == std::string::npos) {
    throw Error(ExitCode::BadInput,
                fmt::format("{} names one picture: write '{}' for a file a frame, or use `offstage still` "
                            "for a single frame",
                            quoted(out), numbered(out)));
  }
  return entry->second;
}

bool holdsSound(OutputKind kind) {
  return kind == OutputKind::Mp4 || kind == OutputKind::Mov || kind == OutputKind::Matroska ||
         kind == OutputKind::WebM;
}

bool isStream(OutputKind kind) {
  return kind == OutputKind::RawPipe || kind == OutputKind::RawFile;
}

void refuseTransparency(const std::filesystem::path& out, std::string_view what) {
  throw Error(
      ExitCode::BadInput,
      fmt::format("{}: {} has no transparency; use .mov (ProRes 4444), .webm (VP9), .mkv with --quality "
                  "lossless (FFV1), .apng, a PNG sequence (frames/%06d.png) or .raw, or an opaque background",
                  quoted(out), what));
}

void refuseQuality(const std::filesystem::path& out, std::string_view why) {
  throw Error(ExitCode::BadInput, fmt::format("{}: {}; leave out --quality", quoted(out), why));
}

} // namespace offstage
