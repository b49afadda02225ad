#include "render/job/poster.h"

#include "render/job/frame_maker.h"
#include "render/job/notice.h"
#include "render/job/schedule.h"
#include "render/job/still.h"
#include "render/output/file_error.h"
#include "render/output/jpeg.h"
#include "render/output/output_kind.h"
#include "render/output/png.h"
#include "src/sim/error.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr double kPerInch = 72.0;
constexpr double kInch = 0.0254;   // m
constexpr double kRounding = 1e-6; // s

/// Whether a poster of this name is a PNG; else it is a JPEG.
bool isPng(const std::filesystem::path& file) {
  const std::string ending = lowerCaseEnding(file);
  if (ending == ".png") return true;
  if (ending == ".jpg" || ending == ".jpeg") return false;
  throw Error(ExitCode::BadInput, fmt::format("{}: a poster ends in .png, .jpg or .jpeg", quoted(file)));
}

/// A moment that the scene's [poster] names may lie where the options have cut.
void tellWhatIsCut(const Source& source, const RenderOptions& options, double at, double shown) {
  if (shown != at) {
    printNotice(fmt::format("the video ends at {} s, before the {} s of [poster]: the poster shows {} s",
                            videoSeconds(source), at, shown));
  } else if (options.from || options.to) {
    const Schedule schedule = scheduleOf(source, options);
    const double end = schedule.origin() + schedule.seconds();
    if (at < schedule.origin() - kRounding || at > end + kRounding)
      printNotice(
          fmt::format("the poster shows {} s, as [poster] says, which is not within the rendered {} … {} s",
                      at, schedule.origin(), end));
  }
}

} // namespace

int printResolution(double scale) {
  return static_cast<int>(std::lround(kPerInch * scale / kInch));
}

Poster::Poster(std::filesystem::path file) : path_(std::move(file)), isPng_(isPng(path_)), file_(path_) {
  removeAbandoned(path_);
}

void Poster::requireFit(const Source& source) const {
  if (isPng_ || pictureOf(source).background.a == 255) return;
  throw Error(
      ExitCode::BadInput,
      fmt::format("{}: a JPEG has no transparency; use .png, or an opaque background", quoted(path_)));
}

double posterMoment(const Source& source, const RenderOptions& options, std::optional<double> at) {
  const double end = videoSeconds(source);
  if (at && *at <= end + kRounding) return *at;
  if (!options.from && !options.to) return end * 0.5;
  const Schedule schedule = scheduleOf(source, options);
  return schedule.origin() + schedule.seconds() * 0.5;
}

void Poster::write(Source& source, const RenderOptions& options, std::optional<double> at, double scale) {
  requireFit(source);
  const double shown = posterMoment(source, options, at);
  if (at) tellWhatIsCut(source, options, *at, shown);
  const bool alpha = pictureOf(source).background.a != 255;
  const Frame frame = drawFrame(source, shown);
  const std::vector<std::uint8_t> bytes =
      isPng_ ? encodePng(frame, alpha, printResolution(scale)) : encodeJpeg(frame);
  file_.write(bytes.data(), bytes.size());
  file_.commit();
}

} // namespace offstage
