#pragma once

#include "render/output/sound.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace offstage {

/// The largest true peak that a limited sound has, full scale being 1: −1.5 dBTP. Half a decibel below the −1
/// dBTP that is promised, because a lossy encoder's peaks differ from those it was given.
inline constexpr double kTruePeakCeiling = 0.8413951416451951;

/// Turns a sound down where its true peak would be above kTruePeakCeiling, and leaves it as it is everywhere
/// else. The true peak is that of the sound at four times its rate, by the interpolating filter of ITU-R
/// BS.1770-4, annex 2. The gain at a sample is the mean, over the 5 ms around it, of the least gain that any
/// sample in the 5 ms around those needs, so it is never more than the sample itself needs, and changes
/// smoothly.
class PeakLimiter : public Sound {
public:
  explicit PeakLimiter(Sound& source) : source_(source) {}

  void rewind() override;
  std::size_t read(std::span<float> samples) override;

private:
  bool pull(); ///< one more pair of the source and the gain that it needs; silence after the source's end
  void refill();
  void pushNeed(double need);

  Sound& source_;
  std::vector<float> block_; ///< read from the source, from `blockNext_` on not yet used
  std::size_t blockNext_ = 0;
  bool sourceEnded_ = false;
  std::int64_t length_ = 0;                      ///< pairs that the source has given
  std::int64_t pulled_ = 0;                      ///< pairs pulled, the silence behind the end included
  std::int64_t given_ = 0;                       ///< pairs returned by read()
  std::deque<std::pair<float, float>> pairs_;    ///< from pair `given_` on
  std::vector<double> recentLeft_, recentRight_; ///< the filter's last 12 samples
  std::deque<std::pair<std::int64_t, double>>
      least_;                 ///< pairs and the gains they need, rising: a sliding minimum
  std::deque<double> minima_; ///< the last minima, whose mean is the gain
  double sum_ = 0.0;          ///< of minima_
};

} // namespace offstage
