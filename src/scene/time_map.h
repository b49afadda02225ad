#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace offstage {

/// Which simulated frame each frame of a video shows: a row of stretches, in each of which the video moves
/// evenly through the simulated frames, or stands. Both are counted from 0 in frames of the same rate. A
/// position between two simulated frames, 3.25, lies a quarter of the way from frame 3 to frame 4. Positions
/// never go back.
///
/// All positions are exact while frame numbers times the terms of a speed's fraction stay below 2^53: k/4 is
/// k divided by 4 once.
class TimeMap {
public:
  /// A stretch of the simulated frames that is shown in so many frames of the video.
  struct Run {
    std::int64_t first = 0, end = 0; ///< simulated frames, first < end
    std::int64_t frames = 1;         ///< of the video, ≥ 1
  };

  /// `frames` simulated frames, each shown once, but for the runs, which are in order and do not overlap.
  explicit TimeMap(std::int64_t frames, const std::vector<Run>& runs = {});

  /// The video stands for `count` frames before its frame `at` (0 … frames()), showing the position of that
  /// frame, or `position` if it is given, which must lie between those of the frames before and at it.
  void stand(std::int64_t at, std::int64_t count, std::optional<double> position = {}, int tag = kNoTag);

  [[nodiscard]] std::int64_t frames() const { return frames_; } ///< of the video
  [[nodiscard]] bool isIdentity() const { return identity_; }
  /// What a frame of the video shows, 0 ≤ frame ≤ frames().
  [[nodiscard]] double position(std::int64_t frame) const;
  /// Whether the video shows more frames there than were simulated, so that positions lie between them.
  [[nodiscard]] bool isSlow(std::int64_t frame) const;
  /// The first frame of the video that shows this position or a later one; frames() when none does.
  [[nodiscard]] std::int64_t firstAt(double position) const;
  /// Where in the video, in frames, this position comes on; of one at which the video stands, the stand's
  /// beginning.
  [[nodiscard]] double inverse(double position) const;
  /// The frames of the video, first and end, for which it stands by a stand() with this tag.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> range(int tag) const;

  static constexpr int kNoTag = -1;

private:
  /// Shows origin + (k − first + skip)·numerator/denominator at frame k of the video.
  struct Stretch {
    std::int64_t first = 0; ///< of the video
    std::int64_t count = 0;
    std::int64_t skip = 0;
    double origin = 0.0;
    double numerator = 1.0, denominator = 1.0; ///< numerator 0: it stands
    int tag = kNoTag;

    [[nodiscard]] double at(std::int64_t frame) const {
      return origin + static_cast<double>(frame - first + skip) * numerator / denominator;
    }
  };
  void append(std::int64_t count, double origin, std::int64_t numerator, std::int64_t denominator);
  [[nodiscard]] const Stretch* find(std::int64_t frame) const;

  std::vector<Stretch> stretches_; ///< in order, without gaps; none is empty
  std::int64_t frames_ = 0;
  double end_ = 0.0; ///< position of frames()
  bool identity_ = true;
};

} // namespace offstage
