#include "render/output/peak_limiter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace offstage {
namespace {

constexpr std::size_t kTaps = 12;
/// The four phases of the interpolating filter (ITU-R BS.1770-4, annex 2, table); the last two are the first
/// two reversed.
constexpr std::array<std::array<double, kTaps>, 2> kPhases{
    {{0.0017089843750, 0.0109863281250, -0.0196533203125, 0.0332031250000, -0.0594482421875, 0.1373291015625,
      0.9721679687500, -0.1022949218750, 0.0476074218750, -0.0266113281250, 0.0148925781250,
      -0.0083007812500},
     {-0.0291748046875, 0.0292968750000, -0.0517578125000, 0.0891113281250, -0.1665039062500, 0.4650878906250,
      0.7797851562500, -0.2003173828125, 0.1015625000000, -0.0582275390625, 0.0330810546875,
      -0.0189208984375}}};
/// The filter's middle lies so many pairs before the last one it has seen.
constexpr std::int64_t kDelay = 6;
constexpr std::int64_t kWindow = 240; ///< pairs: 5 ms
/// A peak between two samples concerns both, wherever the filter's middle is taken to lie.
constexpr std::int64_t kSlack = 2;
/// So many pairs after a sample have to be known before its gain is.
constexpr std::int64_t kLookahead = kWindow + kDelay + kSlack;
constexpr std::size_t kBlock = 4096; ///< pairs

/// The largest of the interpolated values that the last twelve samples give.
double truePeak(const std::vector<double>& recent) {
  double peak = std::abs(recent[kTaps - 1 - kDelay]);
  for (const std::array<double, kTaps>& phase : kPhases) {
    double forward = 0.0;
    double backward = 0.0;
    for (std::size_t i = 0; i < kTaps; ++i) {
      forward += phase[i] * recent[kTaps - 1 - i];
      backward += phase[i] * recent[i];
    }
    peak = std::max({peak, std::abs(forward), std::abs(backward)});
  }
  return peak;
}

} // namespace

void PeakLimiter::rewind() {
  source_.rewind();
  block_.clear();
  blockNext_ = 0;
  sourceEnded_ = false;
  length_ = pulled_ = given_ = 0;
  pairs_.clear();
  recentLeft_.assign(kTaps, 0.0);
  recentRight_.assign(kTaps, 0.0);
  least_.clear();
  minima_.assign(static_cast<std::size_t>(kWindow), 1.0);
  sum_ = static_cast<double>(kWindow);
}

void PeakLimiter::refill() {
  block_.resize(kBlock * kSoundChannels);
  const std::size_t had = source_.read(block_);
  block_.resize(had * kSoundChannels);
  blockNext_ = 0;
  length_ += static_cast<std::int64_t>(had);
  sourceEnded_ = had < kBlock;
}

bool PeakLimiter::pull() {
  if (blockNext_ == block_.size() && !sourceEnded_) refill();
  const bool sounding = blockNext_ < block_.size();
  std::pair<float, float> pair{0.0F, 0.0F};
  if (sounding) {
    pair = {block_[blockNext_], block_[blockNext_ + 1]};
    blockNext_ += kSoundChannels;
    pairs_.push_back(pair);
  }
  const auto shift = [](std::vector<double>& recent, float value) {
    std::rotate(recent.begin(), recent.begin() + 1, recent.end());
    recent.back() = static_cast<double>(value);
  };
  shift(recentLeft_, pair.first);
  shift(recentRight_, pair.second);
  const double peak = std::max(truePeak(recentLeft_), truePeak(recentRight_));
  pushNeed(peak > kTruePeakCeiling ? kTruePeakCeiling / peak : 1.0);
  ++pulled_;
  return sounding;
}

/// The need belongs to the filter's middle; what it lets the minima say is known `kWindow + kSlack` pairs
/// later.
void PeakLimiter::pushNeed(double need) {
  while (!least_.empty() && least_.back().second >= need) least_.pop_back();
  least_.emplace_back(pulled_, need);
  while (least_.front().first <= pulled_ - kWindow - 2 * kSlack) least_.pop_front();
  sum_ += least_.front().second - minima_.front();
  minima_.pop_front();
  minima_.push_back(least_.front().second);
}

std::size_t PeakLimiter::read(std::span<float> samples) {
  if (minima_.empty()) rewind();
  std::size_t done = 0;
  while (done < samples.size()) {
    while (pulled_ <= given_ + kLookahead) pull();
    if (sourceEnded_ && given_ == length_) break;
    const double gain = std::min(sum_ / static_cast<double>(kWindow), 1.0);
    samples[done++] = static_cast<float>(static_cast<double>(pairs_.front().first) * gain);
    samples[done++] = static_cast<float>(static_cast<double>(pairs_.front().second) * gain);
    pairs_.pop_front();
    ++given_;
  }
  return done / kSoundChannels;
}

} // namespace offstage
