#pragma once

#include "render/output/libav.h"
#include "render/output/sound.h"

#include <cstdint>
#include <vector>

namespace offstage {

/// How a video's sound is coded.
enum class SoundCodec { Aac, Opus };

/// What is fixed of one.
struct SoundCodecTraits {
  const char* encoder; ///< FFmpeg's name
  const char* decoded; ///< FFmpeg's name of the codec of a finished file
  const char* title;   ///< for messages
  const char* purpose; ///< the files that it is for
  const char* package; ///< the Debian package that brings it
};
const SoundCodecTraits& traitsOf(SoundCodec codec);

/// A sound as packets for a muxer.
struct EncodedSound {
  libav::CodecParameters parameters;
  AVRational timeBase{1, kSoundRate};
  std::vector<libav::Packet> packets; ///< with pts, dts and duration; those before 0 are the encoder's run-up
};

/// Encodes all of `sound`, from its beginning, cut or filled with silence to `samples` pairs. FFmpeg's own
/// arithmetic runs without the processor's special instructions meanwhile, so that the bytes do not depend on
/// them. (The C library's mathematics, which it calls, differ between processors with and without fused
/// multiply-add only in doubles' last bits, which have not changed a byte: tests/tracks_test.cpp.) Throws
/// Error(Environment) without the encoder.
EncodedSound encodeSound(Sound& sound, std::int64_t samples, SoundCodec codec);

/// Makes FFmpeg's libraries use no special instructions of the processor in what is opened while it lives.
class PlainArithmetic {
public:
  PlainArithmetic();
  ~PlainArithmetic();
  PlainArithmetic(const PlainArithmetic&) = delete;
  PlainArithmetic& operator=(const PlainArithmetic&) = delete;
};

} // namespace offstage
