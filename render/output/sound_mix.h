#pragma once

#include "render/output/peak_limiter.h"
#include "render/output/sound.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace offstage {

/// The loudness that speech is brought to, in LUFS (EBU R 128 names −23 for broadcasting; −16 is what video
/// sites and podcasts use), and how closely.
inline constexpr double kLoudness = -16.0;
inline constexpr double kLoudnessTolerance = 0.1; ///< LU

/// The click of a contact.
struct Click {
  double time = 0.0;  ///< s of the mix
  double share = 1.0; ///< of the loudest click, 0 … 1
};

/// A voice: a sound that begins at a moment.
struct PlacedSound {
  std::shared_ptr<Sound> sound;
  std::int64_t start = 0; ///< pairs of samples from the mix's beginning; < 0: its beginning is cut off
};

/// A video's sound: voices one after another, brought to kLoudness as a whole by one gain (ITU-R BS.1770-4,
/// gated), clicks over them at their own loudness (a damped tone of 1200 Hz, at most −12 dB), and all of it
/// held by a PeakLimiter. Where nothing is heard it is silent, up to `length`.
class SoundMix : public Sound {
public:
  /// `voices` and `clicks` by time; voices do not overlap. `length` in pairs of samples. Reads the voices
  /// twice or more.
  SoundMix(std::vector<PlacedSound> voices, std::vector<Click> clicks, std::int64_t length);
  ~SoundMix() override;

  void rewind() override;
  std::size_t read(std::span<float> samples) override;

  [[nodiscard]] double gain() const; ///< dB: of the voices, once they are measured

private:
  void level(); ///< finds the gain
  class Unlimited;
  std::unique_ptr<Unlimited> unlimited_;
  PeakLimiter limiter_;
  bool levelled_ = false;
};

/// The integrated loudness of a whole sound in LUFS (ITU-R BS.1770-4, by libebur128); −∞ when it is silent.
double loudnessOf(Sound& sound);

} // namespace offstage
