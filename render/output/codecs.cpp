#include "render/output/codecs.h"

#include "render/output/sound_encoder.h"
#include "render/output/video_codec.h"

#include <fmt/format.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
}

namespace offstage {
namespace {

std::string version(const char* library, unsigned packed) {
  return fmt::format("{} {}.{}.{}", library, AV_VERSION_MAJOR(packed), AV_VERSION_MINOR(packed),
                     AV_VERSION_MICRO(packed));
}

} // namespace

std::vector<CodecStatus> codecStatus() {
  std::vector<CodecStatus> codecs;
  for (const CodecTraits& traits : allCodecs())
    codecs.push_back({traits.encoder, traits.purpose, traits.package,
                      avcodec_find_encoder_by_name(traits.encoder) != nullptr});
  for (const SoundCodec codec : {SoundCodec::Aac, SoundCodec::Opus}) {
    const SoundCodecTraits& traits = traitsOf(codec);
    codecs.push_back({traits.encoder, traits.purpose, traits.package,
                      avcodec_find_encoder_by_name(traits.encoder) != nullptr});
  }
  return codecs;
}

std::string libavVersions() {
  return version("libavcodec", avcodec_version()) + ", " + version("libavformat", avformat_version()) + ", " +
         version("libavutil", avutil_version());
}

} // namespace offstage
