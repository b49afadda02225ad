#pragma once

#include "render/output/tracks.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace offstage::test {

/// All that FFmpeg's libraries tell of a file beside its pictures. Times in ns, as a player has them.
struct DecodedTracks {
  std::vector<std::string> codecs; ///< FFmpeg's names, of the streams in order
  std::vector<Chapter> chapters;
  std::vector<Cue> captions; ///< those with a text, as the packets hold it (of mov_text without its length)
  std::string soundCodec;    ///< empty: no sound
  int soundRate = 0;         ///< 1/s
  int soundChannels = 0;
  /// The left channel, sample by sample at soundRate, from time 0 on: what a decoder gives before is left
  /// out.
  std::vector<float> sound;
};

/// Reads and decodes the whole file. Throws std::runtime_error when anything is wrong with it.
DecodedTracks decodeTracks(const std::filesystem::path& file);

/// The first moment (s) from `from` on at which the sound is louder than `threshold`; −1 when it never is.
double onset(const DecodedTracks& tracks, double from, float threshold);

/// Writes samples (full scale ±1) as a 16-bit WAV with one channel.
void writeWav(const std::filesystem::path& file, const std::vector<float>& samples, int rate);

/// A tone of this frequency (Hz), length (s) and amplitude.
std::vector<float> tone(double frequency, double length, double amplitude, int rate);

} // namespace offstage::test
