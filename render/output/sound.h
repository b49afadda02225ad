#pragma once

#include <cstddef>
#include <span>

namespace offstage {

inline constexpr int kSoundRate = 48000; ///< 1/s: samples a second of everything that is heard
inline constexpr int kSoundChannels = 2; ///< left, right

/// Sound that is read from its beginning to its end, as often as wanted.
class Sound {
public:
  virtual ~Sound() = default;
  Sound() = default;
  Sound(const Sound&) = delete;
  Sound& operator=(const Sound&) = delete;

  virtual void rewind() = 0;
  /// The next samples, left and right in turn, full scale being ±1. `samples` holds a whole number of pairs.
  /// Returns how many pairs there were; fewer than asked for only at the end.
  virtual std::size_t read(std::span<float> samples) = 0;
};

} // namespace offstage
