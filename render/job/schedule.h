#pragma once

#include "render/job/render_options.h"
#include "render/job/source.h"
#include "render/output/sink.h"
#include "src/scene/film.h"
#include "src/sim/clock.h"

#include <cstdint>
#include <optional>

namespace offstage {

/// Which frames of a simulation a video shows, and when: N steps give N frames, 0 … N−1, each shown until the
/// next, so that the video lasts exactly as long as the clock. The state after the last step begins at the
/// end and is not shown. A film with a map says otherwise: then the video has the film's constant rate, and
/// stands at the state after the last step where it stands at its end.
class Schedule {
public:
  /// The part of `clock` from `from` to `to` (s of the video, which without a film's map are those of the
  /// clock; absent: start and end). The frames whose time lies within from ≤ time < to are shown; on a
  /// recorded clock the frame on show at `from` comes first. `fps` resamples a recorded clock: each output
  /// frame shows the last simulated frame whose time has come. A fixed clock already has its rate, so `fps`
  /// must be absent there. Throws Error(BadInput) when the part is empty or lies outside the video, or fps is
  /// not finite and > 0. `film` may be null and must outlive this.
  Schedule(const Clock& clock, std::optional<double> from, std::optional<double> to,
           std::optional<double> fps, const Film* film = nullptr);

  [[nodiscard]] std::int64_t frames() const { return frames_; } ///< of the output
  [[nodiscard]] Shot shot(std::int64_t index) const;
  [[nodiscard]] std::int64_t simulated(std::int64_t index) const; ///< which frame of the clock is shown
  [[nodiscard]] double origin() const;                            ///< s of the video: where the output begins
  [[nodiscard]] FrameTiming timing(std::int64_t index) const;     ///< relative to the output's first frame
  [[nodiscard]] double fps() const { return fps_; }               ///< 1/s; 0: variable
  [[nodiscard]] double seconds() const;                           ///< how long the output lasts

private:
  [[nodiscard]] std::int64_t startOf(std::int64_t index) const; ///< ns

  Clock clock_;
  const Film* film_ = nullptr; ///< one with a map, or null
  double fps_ = 0.0;
  double origin_ = 0.0;    ///< s: where a resampled output begins
  std::int64_t first_ = 0; ///< frame of the clock, or of the film, that the output begins with
  std::int64_t frames_ = 0;
  std::int64_t originNs_ = 0; ///< ns: time of the output's start
  std::int64_t endNs_ = 0;    ///< ns: time of the output's end
};

/// The schedule that the options ask for; `fps` resamples only a recorded clock, a fixed one already has it.
Schedule scheduleOf(const Source& source, const RenderOptions& options);

} // namespace offstage
