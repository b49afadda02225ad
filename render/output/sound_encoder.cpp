#include "render/output/sound_encoder.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/format.h>

extern "C" {
#include <libavutil/channel_layout.h>
#include <libavutil/cpu.h>
}

namespace offstage {
namespace {

constexpr std::array<SoundCodecTraits, 2> kSoundCodecs{{
    {"aac", "aac", "AAC", "sound in .mp4 .mov", "libavcodec59"},
    {"libopus", "opus", "Opus", "sound in .mkv .webm", "libavcodec59"},
}};
constexpr std::int64_t kBitRate = 160000; // 1/s: transparent for speech and clicks in either codec

libav::CodecContext openEncoder(SoundCodec codec) {
  const SoundCodecTraits& traits = traitsOf(codec);
  const AVCodec* found = avcodec_find_encoder_by_name(traits.encoder);
  if (found == nullptr)
    throw Error(ExitCode::Environment,
                fmt::format("{} sound needs a libavcodec with {}: install the Debian package {} or "
                            "libavcodec-extra59",
                            traits.title, traits.encoder, traits.package));
  libav::CodecContext context(libav::allocated(avcodec_alloc_context3(found)));
  context->sample_rate = kSoundRate;
  context->ch_layout = AV_CHANNEL_LAYOUT_STEREO;
  // AAC takes its channels one after the other, Opus in turn.
  context->sample_fmt = codec == SoundCodec::Aac ? AV_SAMPLE_FMT_FLTP : AV_SAMPLE_FMT_FLT;
  context->bit_rate = kBitRate;
  context->time_base = {1, kSoundRate};
  context->thread_count = 1;
  context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
  libav::check(avcodec_open2(context.get(), found, nullptr), ExitCode::Environment,
               fmt::format("{} does not open", traits.encoder));
  return context;
}

class SoundEncoder {
public:
  SoundEncoder(std::int64_t samples, SoundCodec codec) : samples_(samples), context_(openEncoder(codec)) {
    libav::check(avcodec_parameters_from_context(parameters(), context_.get()), ExitCode::Environment,
                 "libavcodec does not describe its stream");
    frame_ = libav::makeFrame();
    packet_ = libav::makePacket();
  }

  EncodedSound encode(Sound& sound) {
    const int most = context_->frame_size;
    std::vector<float> pairs(static_cast<std::size_t>(most) * kSoundChannels);
    sound.rewind();
    for (std::int64_t done = 0; done < samples_; done += most) {
      const auto count = static_cast<int>(std::min<std::int64_t>(most, samples_ - done));
      const std::span<float> part(pairs.data(), static_cast<std::size_t>(count) * kSoundChannels);
      const std::size_t had = sound.read(part);
      std::fill(part.begin() + static_cast<std::ptrdiff_t>(had * kSoundChannels), part.end(), 0.0F);
      fill(part, count, done);
      send(frame_.get());
    }
    send(nullptr);
    endExactly();
    return std::move(result_);
  }

private:
  AVCodecParameters* parameters() {
    result_.parameters.reset(libav::allocated(avcodec_parameters_alloc()));
    return result_.parameters.get();
  }

  void fill(std::span<const float> pairs, int count, std::int64_t start) {
    AVFrame& frame = *frame_;
    av_frame_unref(&frame);
    frame.format = context_->sample_fmt;
    frame.sample_rate = kSoundRate;
    frame.nb_samples = count;
    frame.pts = start;
    libav::check(av_channel_layout_copy(&frame.ch_layout, &context_->ch_layout), ExitCode::Transient,
                 "no memory for sound");
    libav::check(av_frame_get_buffer(&frame, 0), ExitCode::Transient, "no memory for sound");
    if (av_sample_fmt_is_planar(context_->sample_fmt) == 0) {
      std::ranges::copy(pairs, reinterpret_cast<float*>(frame.data[0]));
      return;
    }
    for (std::size_t channel = 0; channel < kSoundChannels; ++channel) {
      auto* plane = reinterpret_cast<float*>(frame.data[channel]);
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        plane[i] = pairs[i * kSoundChannels + channel];
    }
  }

  void send(const AVFrame* frame) {
    libav::check(avcodec_send_frame(context_.get(), frame), ExitCode::Transient,
                 "the sound's encoder does not take samples");
    while (true) {
      const int result = avcodec_receive_packet(context_.get(), packet_.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      libav::check(result, ExitCode::Transient, "the sound's encoder fails");
      libav::Packet kept = libav::makePacket();
      av_packet_move_ref(kept.get(), packet_.get());
      result_.packets.push_back(std::move(kept));
    }
  }

  /// The last packets hold more than the sound: they last only until its end.
  void endExactly() {
    while (!result_.packets.empty() && result_.packets.back()->pts >= samples_) result_.packets.pop_back();
    if (result_.packets.empty()) return;
    AVPacket& last = *result_.packets.back();
    last.duration = std::min(last.duration, samples_ - last.pts);
  }

  std::int64_t samples_;
  libav::CodecContext context_;
  libav::VideoFrame frame_;
  libav::Packet packet_;
  EncodedSound result_;
};

} // namespace

const SoundCodecTraits& traitsOf(SoundCodec codec) {
  return kSoundCodecs.at(static_cast<std::size_t>(codec));
}

EncodedSound encodeSound(Sound& sound, std::int64_t samples, SoundCodec codec) {
  libav::quietLog();
  const PlainArithmetic plain;
  return SoundEncoder(samples, codec).encode(sound);
}

PlainArithmetic::PlainArithmetic() {
  av_force_cpu_flags(0);
}

PlainArithmetic::~PlainArithmetic() {
  av_force_cpu_flags(-1);
}

} // namespace offstage
