#pragma once

#include "render/output/libav.h"
#include "render/output/muxer.h"
#include "render/output/quality.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace offstage {

/// How the frames of a video are coded.
enum class VideoCodec : std::uint8_t {
  H264,    ///< High, yuv420p
  H264Rgb, ///< High 4:4:4 Predictive, RGB, lossless
  Vp9,     ///< yuv420p, with transparency yuva420p
  ProRes,  ///< 4444, 4:4:4 in 10 bits with transparency
  Ffv1,    ///< RGB with transparency, lossless
};

/// What is fixed of a codec.
struct CodecTraits {
  VideoCodec codec;
  const char* encoder;  ///< FFmpeg's name
  const char* purpose;  ///< the files it is for
  const char* package;  ///< the Debian package that brings it
  const char* title;    ///< for messages
  bool rgb;             ///< keeps RGB; else BT.709 in limited range
  bool subsampled;      ///< 4:2:0: odd sizes are padded to even
  int leastSide;        ///< px; of FFV1, smaller ones come back from FFmpeg as other pixels, or not at all
  int mostSide;         ///< px
  const char* decoded;  ///< FFmpeg's name of the codec of a finished file
  const char* profile;  ///< FFmpeg's name, of a finished file; null: not compared
  AVPixelFormat opaque; ///< pixel format without transparency; AV_PIX_FMT_NONE: has always some
  AVPixelFormat alpha;  ///< with transparency; AV_PIX_FMT_NONE: has none
  AVPixelFormat read;   ///< what FFmpeg's decoder gives
};

const CodecTraits& traitsOf(VideoCodec codec);
const std::vector<CodecTraits>& allCodecs();

/// The codec for a container, with or without transparency, at a quality. Throws Error(BadInput), naming what
/// to use instead, where the container has none.
VideoCodec chooseCodec(const std::filesystem::path& out, Container container, bool alpha, Quality quality);

/// The encoder's options, as FFmpeg names them.
std::vector<std::pair<std::string, std::string>> optionsOf(VideoCodec codec, Quality quality);

} // namespace offstage
