#include "render/output/sound_reader.h"

#include "render/output/sound_encoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

extern "C" {
#include <libavutil/channel_layout.h>
#include <libswresample/swresample.h>
}

namespace offstage {
namespace {

/// Demuxers that read one file and name no others.
constexpr const char* kFormats = "wav,w64,mp3,mov,mp4,m4a,flac,ogg,aiff";
constexpr std::int64_t kMostSamples = std::int64_t{4} * 3600 * kSoundRate;
constexpr int kLeastRate = 1000;
constexpr int kMostRate = 768000;
/// A sample beyond this is no sound but damage; full scale is 1.
constexpr float kLoudest = 8.0F;

} // namespace

void SoundReader::FreeResampler::operator()(SwrContext* context) const {
  swr_free(&context);
}

void SoundReader::fail(const std::string& why) {
  throw Error(ExitCode::BadInput, why);
}

int SoundReader::check(int result, const char* what) {
  if (result < 0) fail(fmt::format("{} ({})", what, libav::errorText(result)));
  return result;
}

SoundReader::SoundReader(std::filesystem::path file)
    : file_(std::move(file)), packet_(libav::makePacket()), frame_(libav::makeFrame()) {
  open();
}

SoundReader::~SoundReader() = default;

void SoundReader::rewind() {
  open();
}

void SoundReader::open() {
  const PlainArithmetic plain;
  ready_.clear();
  taken_ = 0;
  drained_ = false;
  check(libav::openInput(file_, format_, kFormats), "is no sound file that can be read");
  check(avformat_find_stream_info(format_.get(), nullptr), "has no sound that is recognised");
  stream_ = av_find_best_stream(format_.get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
  if (stream_ < 0) fail("holds no sound");
  openDecoder();
  openResampler();
}

void SoundReader::openDecoder() {
  const AVStream& stream = *format_->streams[stream_];
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr)
    fail(fmt::format("holds {}, which libavcodec cannot decode here",
                     avcodec_get_name(stream.codecpar->codec_id)));
  decoder_.reset(libav::allocated(avcodec_alloc_context3(codec)));
  check(avcodec_parameters_to_context(decoder_.get(), stream.codecpar), "does not describe its sound");
  decoder_->pkt_timebase = stream.time_base; // by which the decoder leaves out what an encoder has added
  decoder_->thread_count = 1;
  check(avcodec_open2(decoder_.get(), codec, nullptr), "cannot be decoded");
}

void SoundReader::openResampler() {
  const int rate = decoder_->sample_rate;
  if (rate < kLeastRate || rate > kMostRate)
    fail(fmt::format("has {} samples a second, not from {} to {}", rate, kLeastRate, kMostRate));
  if (decoder_->ch_layout.nb_channels <= 0) fail("does not describe its sound");
  AVChannelLayout from{};
  if (decoder_->ch_layout.order == AV_CHANNEL_ORDER_UNSPEC)
    av_channel_layout_default(&from, decoder_->ch_layout.nb_channels);
  else
    check(av_channel_layout_copy(&from, &decoder_->ch_layout), "does not describe its sound");
  AVChannelLayout to = AV_CHANNEL_LAYOUT_STEREO;
  SwrContext* made = nullptr;
  const int result = swr_alloc_set_opts2(&made, &to, AV_SAMPLE_FMT_FLT, kSoundRate, &from,
                                         decoder_->sample_fmt, decoder_->sample_rate, 0, nullptr);
  resampler_.reset(made);
  av_channel_layout_uninit(&from);
  check(result, "cannot be brought to 48 kHz");
  check(swr_init(made), "cannot be brought to 48 kHz");
}

/// Hands the decoder a packet, or the end.
void SoundReader::feed() {
  while (true) {
    const int result = av_read_frame(format_.get(), packet_.get());
    if (result == AVERROR_EOF) {
      check(avcodec_send_packet(decoder_.get(), nullptr), "cannot be decoded to its end");
      return;
    }
    check(result, "is damaged");
    const bool wanted = packet_->stream_index == stream_;
    const int sent = wanted ? avcodec_send_packet(decoder_.get(), packet_.get()) : 0;
    av_packet_unref(packet_.get());
    check(sent, "is damaged");
    if (wanted) return;
  }
}

void SoundReader::resample(const AVFrame* frame) {
  const int had = frame == nullptr ? 0 : frame->nb_samples;
  const int room = check(swr_get_out_samples(resampler_.get(), had), "cannot be brought to 48 kHz");
  const std::size_t before = ready_.size();
  ready_.resize(before + static_cast<std::size_t>(room) * kSoundChannels);
  std::array<std::uint8_t*, 1> to{reinterpret_cast<std::uint8_t*>(ready_.data() + before)};
  const auto** from = frame == nullptr ? nullptr : const_cast<const std::uint8_t**>(frame->extended_data);
  const int made =
      check(swr_convert(resampler_.get(), to.data(), room, from, had), "cannot be brought to 48 kHz");
  ready_.resize(before + static_cast<std::size_t>(made) * kSoundChannels);
  for (std::size_t i = before; i < ready_.size(); ++i)
    ready_[i] = std::isfinite(ready_[i]) ? std::clamp(ready_[i], -kLoudest, kLoudest) : 0.0F;
}

bool SoundReader::decodeMore() {
  if (drained_) return false;
  while (true) {
    const int result = avcodec_receive_frame(decoder_.get(), frame_.get());
    if (result == AVERROR_EOF) {
      drained_ = true;
      resample(nullptr);
      return true;
    }
    if (result == AVERROR(EAGAIN)) {
      feed();
      continue;
    }
    check(result, "is damaged");
    if (frame_->sample_rate != decoder_->sample_rate || frame_->format != decoder_->sample_fmt ||
        frame_->ch_layout.nb_channels != decoder_->ch_layout.nb_channels)
      fail("changes its rate or its channels on the way");
    resample(frame_.get());
    return true;
  }
}

std::size_t SoundReader::read(std::span<float> samples) {
  std::size_t done = 0;
  while (done < samples.size()) {
    if (taken_ == ready_.size()) {
      ready_.clear();
      taken_ = 0;
      if (!decodeMore()) break;
      continue;
    }
    const std::size_t count = std::min(samples.size() - done, ready_.size() - taken_);
    std::copy_n(ready_.begin() + static_cast<std::ptrdiff_t>(taken_), count,
                samples.begin() + static_cast<std::ptrdiff_t>(done));
    taken_ += count;
    done += count;
  }
  return done / kSoundChannels;
}

std::int64_t countSamples(Sound& sound) {
  std::vector<float> part(std::size_t{kSoundRate} * kSoundChannels);
  std::int64_t count = 0;
  sound.rewind();
  while (const std::size_t had = sound.read(part)) {
    count += static_cast<std::int64_t>(had);
    if (count > kMostSamples) throw Error(ExitCode::BadInput, "lasts more than four hours");
  }
  if (count == 0) throw Error(ExitCode::BadInput, "holds no sound");
  return count;
}

} // namespace offstage
