#include "render/output/encoder.h"

#include <string>

#include <fmt/format.h>

namespace offstage {

namespace {

// Chosen on workload R of the bench (N moving opaque circles, 1920 × 1080, white; x264 0.164, one thread of
// an EPYC), with cpu-independent=1 throughout. CPU ms a frame | bytes a frame | SSIM against the frames
// before encoding:
//   settings                             N = 10              N = 1000            N = 10000
//   veryfast crf 20                      18 |  920 | .99956  49 | 34679 | .9862  91 | 226284 | .9505
//   veryfast crf 18                      14 | 1092 | .99965  56 | 42262 | .9891  87 | 273745 | .9620
//   + bframes=8 b-adapt=0 lookahead 10   15 |  911 | .99961  47 | 41525 | .9873  88 | 280576 | .9571
//   + subme=1 b-adapt=0                  10 | 1217 | .99964  35 | 46268 | .9894  73 | 284405 | .9647   <-
//   this one fast crf 18                          26 |  976 | .99972  94 | 38629 | .9912 181 | 256493 | .9714
// Psychovisual optimisation does nothing below subme 6. Without adaptive quantisation the quality rises as
// much as the size. crf 18 keeps the antialiased edges free of visible ringing; a lecture scene stays below
// 1/255 in the mean.
constexpr const char* kPreset = "veryfast";
constexpr const char* kConstantRateFactor = "18";
// cpu-independent: else x264 chooses some algorithms by the processor, and the bytes with them.
constexpr const char* kX264Params = "subme=1:b-adapt=0:cpu-independent=1";

const AVCodec& findX264() {
  const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
  if (codec == nullptr) {
    throw Error(ExitCode::Environment,
                "H.264 video needs a libavcodec with libx264: install the Debian package libavcodec59 or "
                "libavcodec-extra59, and libx264-164");
  }
  return *codec;
}

} // namespace

VideoEncoder::VideoEncoder(const EncoderSettings& settings) : settings_(settings) {
  libav::quietLog();
  const AVCodec& codec = findX264();
  context_.reset(libav::allocated(avcodec_alloc_context3(&codec)));
  AVCodecContext& context = *context_;
  context.width = evenSize(settings.width);
  context.height = evenSize(settings.height);
  context.time_base = settings.timeBase;
  context.framerate = settings.frameRate;
  context.sample_aspect_ratio = {1, 1};
  context.pix_fmt = AV_PIX_FMT_YUV420P;
  context.color_primaries = AVCOL_PRI_BT709;
  context.color_trc = AVCOL_TRC_BT709;
  context.colorspace = AVCOL_SPC_BT709;
  context.color_range = AVCOL_RANGE_MPEG;
  context.chroma_sample_location = AVCHROMA_LOC_LEFT;
  context.profile = FF_PROFILE_H264_HIGH;
  context.gop_size = settings.keyInterval;
  context.thread_count = 1;
  // Parameter sets in the file's header instead of before every key frame, as .mp4 wants them.
  context.flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_CLOSED_GOP;

  libav::Options options;
  options.set("preset", kPreset);
  options.set("profile", "high");
  options.set("crf", kConstantRateFactor);
  options.set("x264-params", kX264Params);
  libav::check(avcodec_open2(&context, &codec, options.get()), ExitCode::BadInput,
               fmt::format("H.264 cannot encode pictures of {} × {} px", context.width, context.height));
  options.requireAllTaken();

  parameters_.reset(libav::allocated(avcodec_parameters_alloc()));
  libav::check(avcodec_parameters_from_context(parameters_.get(), &context), ExitCode::Environment,
               "libavcodec does not describe its H.264 stream");

  picture_ = libav::makeFrame();
  picture_->format = context.pix_fmt;
  picture_->width = context.width;
  picture_->height = context.height;
  libav::check(av_frame_get_buffer(picture_.get(), 0), ExitCode::BadInput, "no memory for a picture");
  packet_ = libav::makePacket();
}

void VideoEncoder::encode(const Frame& frame, std::int64_t start, std::int64_t duration,
                          const PacketTaker& take) {
  AVFrame& picture = *picture_;
  // The encoder may still hold a reference to the planes.
  libav::check(av_frame_make_writable(&picture), ExitCode::Transient, "no memory for a picture");
  converter_.convert(frame, {picture.data[0], picture.data[1], picture.data[2], picture.linesize[0],
                             picture.linesize[1], picture.linesize[2]});
  picture.pts = start;
  durations_.emplace(start, duration);
  send(&picture, take);
}

void VideoEncoder::drain(const PacketTaker& take) {
  send(nullptr, take);
}

void VideoEncoder::send(const AVFrame* picture, const PacketTaker& take) {
  libav::check(avcodec_send_frame(context_.get(), picture), ExitCode::Transient,
               "libx264 does not take a frame");
  while (true) {
    const int result = avcodec_receive_packet(context_.get(), packet_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    libav::check(result, ExitCode::Transient, "libx264 fails to encode a frame");
    const auto entry = durations_.find(packet_->pts);
    if (entry == durations_.end()) throw std::logic_error("libx264 gives a packet that belongs to no frame");
    packet_->duration = entry->second;
    packet_->dts = AV_NOPTS_VALUE;
    durations_.erase(entry);
    take(*packet_);
    av_packet_unref(packet_.get());
  }
}

} // namespace offstage
