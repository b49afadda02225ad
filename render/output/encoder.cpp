#include "render/output/encoder.h"

#include "render/output/chunk_plan.h"
#include "render/output/yuv.h"

#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

const AVCodec& findEncoder(VideoCodec codec) {
  const CodecTraits& traits = traitsOf(codec);
  const AVCodec* found = avcodec_find_encoder_by_name(traits.encoder);
  if (found == nullptr) {
    throw Error(
        ExitCode::Environment,
        fmt::format("{} needs a libavcodec with {}: install the Debian package {} or libavcodec-extra59",
                    traits.title, traits.encoder, traits.package));
  }
  return *found;
}

void setColour(AVCodecContext& context, const CodecTraits& traits) {
  context.color_primaries = AVCOL_PRI_BT709;
  if (traits.rgb) {
    context.color_trc = AVCOL_TRC_IEC61966_2_1; // sRGB
    context.colorspace = AVCOL_SPC_RGB;
    context.color_range = AVCOL_RANGE_JPEG;
    return;
  }
  context.color_trc = AVCOL_TRC_BT709;
  context.colorspace = AVCOL_SPC_BT709;
  context.color_range = AVCOL_RANGE_MPEG;
  if (traits.subsampled) context.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

} // namespace

void requireEncoder(VideoCodec codec) {
  findEncoder(codec);
}

VideoEncoder::VideoEncoder(const EncoderSettings& settings) : traits_(traitsOf(settings.codec)) {
  libav::quietLog();
  const AVCodec& codec = findEncoder(settings.codec);
  context_.reset(libav::allocated(avcodec_alloc_context3(&codec)));
  AVCodecContext& context = *context_;
  context.width = traits_.subsampled ? evenSize(settings.width) : settings.width;
  context.height = traits_.subsampled ? evenSize(settings.height) : settings.height;
  context.time_base = settings.timeBase;
  context.framerate = settings.frameRate;
  context.sample_aspect_ratio = {1, 1};
  context.pix_fmt = settings.alpha ? traits_.alpha : traits_.opaque;
  context.gop_size = kMostChunkFrames;
  context.thread_count = 1;
  setColour(context, traits_);
  // Parameter sets in the file's header instead of before every key frame, as .mp4 wants them.
  context.flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_CLOSED_GOP;

  libav::Options options;
  for (const auto& [key, value] : optionsOf(settings.codec, settings.quality)) {
    if (key == "global_quality") { // means nothing without its flag
      context.flags |= AV_CODEC_FLAG_QSCALE;
    }
    options.set(key.c_str(), value);
  }
  libav::check(avcodec_open2(&context, &codec, options.get()),
               ExitCode::Transient, // what is too large was refused
               fmt::format("{} does not begin to encode pictures of {} × {} px; is memory short?",
                           traits_.title, context.width, context.height));
  options.requireAllTaken();

  parameters_.reset(libav::allocated(avcodec_parameters_alloc()));
  libav::check(avcodec_parameters_from_context(parameters_.get(), &context), ExitCode::Environment,
               "libavcodec does not describe its stream");

  picture_ = libav::makeFrame();
  picture_->format = context.pix_fmt;
  picture_->width = context.width;
  picture_->height = context.height;
  // ProRes takes the colour from each picture.
  picture_->color_primaries = context.color_primaries;
  picture_->color_trc = context.color_trc;
  picture_->colorspace = context.colorspace;
  picture_->color_range = context.color_range;
  libav::check(av_frame_get_buffer(picture_.get(), 0), ExitCode::BadInput, "no memory for a picture");
  packet_ = libav::makePacket();
  converter_ = makePixelConverter(context.pix_fmt);
}

void VideoEncoder::encode(const Frame& frame, std::int64_t start, std::int64_t duration,
                          const PacketTaker& take) {
  AVFrame& picture = *picture_;
  // The encoder may still hold a reference to the planes; a copy holds the same pixels.
  libav::check(av_frame_make_writable(&picture), ExitCode::Transient, "no memory for a picture");
  converter_->convert(frame, picture);
  picture.pts = start;
  picture.quality = context_->global_quality; // … and so its quality
  durations_.emplace(start, duration);
  send(&picture, take);
}

void VideoEncoder::drain(const PacketTaker& take) {
  send(nullptr, take);
}

void VideoEncoder::send(const AVFrame* picture, const PacketTaker& take) {
  libav::check(avcodec_send_frame(context_.get(), picture), ExitCode::Transient,
               "the encoder does not take a frame");
  while (true) {
    const int result = avcodec_receive_packet(context_.get(), packet_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    libav::check(result, ExitCode::Transient, "the encoder fails to encode a frame");
    const auto entry = durations_.find(packet_->pts);
    if (entry == durations_.end())
      throw std::logic_error("the encoder gives a packet that belongs to no frame");
    packet_->duration = entry->second;
    packet_->dts = AV_NOPTS_VALUE;
    durations_.erase(entry);
    take(*packet_);
    av_packet_unref(packet_.get());
  }
}

} // namespace offstage
