#include "render/job/rehearsal.h"

#include "render/job/interrupt.h"
#include "render/job/poster.h"
#include "render/job/schedule.h"
#include "render/job/still.h"

#include <algorithm>

namespace offstage {
namespace {

/// The frame at which a source stands when it shows a moment.
std::int64_t frameOf(const Moment& moment) {
  return moment.frame + (moment.fraction > 0.0 ? 1 : 0);
}

} // namespace

void rehearse(Source& source, std::int64_t frame) {
  while (source.frame() < frame) {
    throwIfInterrupted();
    source.step();
  }
}

void rehearse(Source& source, const RenderOptions& options, std::optional<double> posterAt) {
  std::int64_t last = 0;
  if (!options.out.empty() || !options.hashFile.empty()) {
    const Schedule schedule = scheduleOf(source, options);
    last = frameOf(schedule.shot(schedule.frames() - 1).moment);
  }
  if (!options.poster.empty()) {
    const double at = posterMoment(source, options, posterAt);
    last = std::max(last, frameOf(shotAt(source, at).moment));
  }
  rehearse(source, last);
}

} // namespace offstage
