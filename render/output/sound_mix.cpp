#include "render/output/sound_mix.h"

#include "src/sim/error.h"
#include "src/sim/strict_math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ebur128.h>
#include <new>
#include <utility>

namespace offstage {
namespace {

/// y(n) = a·y(n−1) − b·y(n−2) is a damped tone: a = 2r·cos(w), b = r², y(1) = r·sin(w), with w =
/// 2π·1200/48000 and r = exp(−1/240), which lets it die away by 1/e in 5 ms.
constexpr double kToneA = 1.9671630685946735;
constexpr double kToneB = 0.991701292638876;
constexpr double kToneStart = 0.15578401082323237;
constexpr std::int64_t kClickLength = 2400; ///< pairs: 50 ms, after which it has sunk by 87 dB
constexpr double kLoudestClick = 0.25;      ///< −12 dB of full scale
constexpr double kSoftestShare = 0.15;      ///< of that: the amplitude of the least click

constexpr std::size_t kBlock = 4096; ///< pairs
/// dB: no recording needs more, and one that is nearly silent is noise.
constexpr double kMostGain = 40.0;
constexpr int kMostPasses = 4;

const std::array<float, kClickLength>& clickShape() {
  static const std::array<float, kClickLength> kShape = [] {
    std::array<float, kClickLength> shape{};
    double before = 0.0;
    double now = kToneStart;
    for (std::size_t i = 1; i < shape.size(); ++i) {
      shape[i] = static_cast<float>(now);
      const double next = kToneA * now - kToneB * before;
      before = now;
      now = next;
    }
    return shape;
  }();
  return kShape;
}

std::int64_t pairsOf(double seconds) {
  return std::llround(seconds * kSoundRate);
}

struct FreeMeter {
  void operator()(ebur128_state* state) const { ebur128_destroy(&state); }
};

} // namespace

double loudnessOf(Sound& sound) {
  const std::unique_ptr<ebur128_state, FreeMeter> meter(
      ebur128_init(kSoundChannels, static_cast<unsigned long>(kSoundRate), EBUR128_MODE_I));
  if (!meter) throw std::bad_alloc();
  std::vector<float> part(kBlock * kSoundChannels);
  sound.rewind();
  while (const std::size_t had = sound.read(part)) {
    if (ebur128_add_frames_float(meter.get(), part.data(), had) != EBUR128_SUCCESS) throw std::bad_alloc();
  }
  double loudness = -HUGE_VAL;
  if (ebur128_loudness_global(meter.get(), &loudness) != EBUR128_SUCCESS) throw std::bad_alloc();
  return loudness;
}

/// The voices with their gain, and the clicks.
class SoundMix::Unlimited : public Sound {
public:
  Unlimited(std::vector<PlacedSound> voices, std::vector<Click> clicks, std::int64_t length)
      : voices_(std::move(voices)), clicks_(std::move(clicks)), length_(length) {}

  void rewind() override {
    at_ = 0;
    voice_ = 0;
    voiceOpen_ = false;
  }

  std::size_t read(std::span<float> samples) override {
    const auto pairs =
        std::min<std::int64_t>(static_cast<std::int64_t>(samples.size() / kSoundChannels), length_ - at_);
    const auto part = samples.first(static_cast<std::size_t>(pairs) * kSoundChannels);
    std::ranges::fill(part, 0.0F);
    addVoices(part, pairs);
    for (float& sample : part) sample *= factor_;
    if (withClicks_) addClicks(part, pairs);
    at_ += pairs;
    return static_cast<std::size_t>(pairs);
  }

  void setGain(double decibels) {
    gain_ = decibels;
    factor_ = static_cast<float>(strict::pow(10.0, decibels / 20.0));
  }
  [[nodiscard]] double gain() const { return gain_; }
  void setClicks(bool on) { withClicks_ = on; }
  [[nodiscard]] bool hasVoices() const { return !voices_.empty(); }

private:
  void openVoice(std::int64_t skip) {
    voices_[voice_].sound->rewind();
    voiceOpen_ = true;
    std::vector<float> dropped(kBlock * kSoundChannels);
    while (skip > 0) {
      const auto count = static_cast<std::size_t>(std::min<std::int64_t>(skip, kBlock));
      if (voices_[voice_].sound->read(std::span(dropped).first(count * kSoundChannels)) < count) break;
      skip -= static_cast<std::int64_t>(count);
    }
  }

  void addVoices(std::span<float> part, std::int64_t pairs) {
    std::int64_t done = 0;
    while (voice_ < voices_.size() && done < pairs) {
      const std::int64_t start = voices_[voice_].start;
      if (!voiceOpen_) {
        if (start >= at_ + pairs) return;
        done = std::max(done, start - at_);
        openVoice(std::max<std::int64_t>(at_ + done - start, 0));
      }
      const auto room = part.subspan(static_cast<std::size_t>(done) * kSoundChannels);
      const std::size_t had = voices_[voice_].sound->read(room);
      done += static_cast<std::int64_t>(had);
      if (had * kSoundChannels == room.size()) return;
      ++voice_;
      voiceOpen_ = false;
    }
  }

  void addClicks(std::span<float> part, std::int64_t pairs) {
    const auto first = std::ranges::lower_bound(clicks_, at_ - kClickLength, {},
                                                [](const Click& click) { return pairsOf(click.time); });
    for (auto click = first; click != clicks_.end(); ++click) {
      const std::int64_t start = pairsOf(click->time) - at_;
      if (start >= pairs) return;
      const auto amplitude =
          static_cast<float>(kLoudestClick * (kSoftestShare + (1.0 - kSoftestShare) * click->share));
      for (std::int64_t i = std::max<std::int64_t>(start, 0); i < std::min(start + kClickLength, pairs);
           ++i) {
        const float value = amplitude * clickShape()[static_cast<std::size_t>(i - start)];
        for (std::size_t channel = 0; channel < kSoundChannels; ++channel)
          part[static_cast<std::size_t>(i) * kSoundChannels + channel] += value;
      }
    }
  }

  std::vector<PlacedSound> voices_;
  std::vector<Click> clicks_;
  std::int64_t length_;
  double gain_ = 0.0;
  float factor_ = 1.0F;
  bool withClicks_ = true;
  std::int64_t at_ = 0;   ///< pair that the next read() begins with
  std::size_t voice_ = 0; ///< that sounds now or next
  bool voiceOpen_ = false;
};

SoundMix::SoundMix(std::vector<PlacedSound> voices, std::vector<Click> clicks, std::int64_t length)
    : unlimited_(std::make_unique<Unlimited>(std::move(voices), std::move(clicks), length)),
      limiter_(*unlimited_) {}

void SoundMix::level() {
  levelled_ = true;
  if (!unlimited_->hasVoices()) return;
  // The limiter takes a little off what is loud, so its result is measured again. Hundredths of a decibel
  // make the gain the same on every machine, whatever the last bit of the measurement.
  unlimited_->setClicks(false);
  double loudness = loudnessOf(*unlimited_);
  for (int pass = 0; pass < kMostPasses && std::isfinite(loudness); ++pass) {
    const double missing = kLoudness - loudness;
    if (std::abs(missing) <= kLoudnessTolerance) break;
    const double gain = std::clamp(unlimited_->gain() + missing, -kMostGain, kMostGain);
    unlimited_->setGain(std::round(gain * 100.0) / 100.0);
    loudness = loudnessOf(limiter_);
  }
  unlimited_->setClicks(true);
}

SoundMix::~SoundMix() = default;

void SoundMix::rewind() {
  if (!levelled_) level();
  limiter_.rewind();
}

std::size_t SoundMix::read(std::span<float> samples) {
  if (!levelled_) rewind();
  return limiter_.read(samples);
}

double SoundMix::gain() const {
  return unlimited_->gain();
}

} // namespace offstage
