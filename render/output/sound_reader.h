#pragma once

#include "render/output/input_file.h"
#include "render/output/sound.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

struct SwrContext;

namespace offstage {

/// A sound file (WAV, MP3, M4A, FLAC, Ogg, AIFF) as stereo at 48 kHz: one channel goes to both sides, more
/// than two are mixed down. The silence that an encoder has put before and after a sound is left out where
/// the file tells of it. Everything throws Error(BadInput) when the file is not such a sound or is damaged;
/// the message begins behind the file's name ("holds no sound").
class SoundReader : public Sound {
public:
  explicit SoundReader(std::filesystem::path file);
  ~SoundReader() override;

  void rewind() override;
  std::size_t read(std::span<float> samples) override;

private:
  struct FreeResampler {
    void operator()(SwrContext* context) const;
  };
  void open();
  void openDecoder();
  void openResampler();
  bool decodeMore(); ///< false at the end
  void feed();
  void resample(const AVFrame* frame);
  [[noreturn]] static void fail(const std::string& why);
  static int check(int result, const char* what);

  std::filesystem::path file_;
  libav::InputContext format_;
  libav::CodecContext decoder_;
  std::unique_ptr<SwrContext, FreeResampler> resampler_;
  libav::Packet packet_;
  libav::VideoFrame frame_; ///< an AVFrame holds sound as well
  int stream_ = -1;
  bool drained_ = false;
  std::vector<float> ready_; ///< decoded and not yet read, from `taken_` on
  std::size_t taken_ = 0;
};

/// How many pairs of samples a sound has. Throws Error(BadInput) as SoundReader, and when there are none or
/// more than four hours of them.
std::int64_t countSamples(Sound& sound);

} // namespace offstage
