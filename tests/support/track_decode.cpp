#include "tests/support/track_decode.h"

#include "tests/support/libav_handles.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace offstage::test {
namespace {

constexpr AVRational kNanosecond{1, 1000000000};

/// Puts a decoded piece where its time says.
void place(const AVFrame& frame, AVRational timeBase, DecodedTracks& tracks) {
  const std::int64_t at = av_rescale_q(frame.pts, timeBase, {1, frame.sample_rate});
  const auto* samples = reinterpret_cast<const float*>(frame.extended_data[0]);
  const int step = av_sample_fmt_is_planar(static_cast<AVSampleFormat>(frame.format)) != 0
                       ? 1
                       : frame.ch_layout.nb_channels;
  if (static_cast<AVSampleFormat>(frame.format) != AV_SAMPLE_FMT_FLTP &&
      static_cast<AVSampleFormat>(frame.format) != AV_SAMPLE_FMT_FLT)
    throw std::runtime_error("sound is not decoded to floats");
  for (int i = 0; i < frame.nb_samples; ++i) {
    if (at + i < 0) continue;
    const auto index = static_cast<std::size_t>(at + i);
    if (tracks.sound.size() <= index) tracks.sound.resize(index + 1);
    tracks.sound[index] = samples[static_cast<std::ptrdiff_t>(i) * step];
  }
}

void addCue(const AVPacket& packet, const AVStream& stream, DecodedTracks& tracks) {
  std::string_view text(reinterpret_cast<const char*>(packet.data), static_cast<std::size_t>(packet.size));
  if (stream.codecpar->codec_id == AV_CODEC_ID_MOV_TEXT) {
    if (text.size() < 2) throw std::runtime_error("a caption without its length");
    const auto length = static_cast<std::size_t>(static_cast<unsigned char>(text[0]) * 256 +
                                                 static_cast<unsigned char>(text[1]));
    text = text.substr(2, length);
  }
  if (text.empty()) return;
  tracks.captions.push_back({av_rescale_q(packet.pts, stream.time_base, kNanosecond),
                             av_rescale_q(packet.pts + packet.duration, stream.time_base, kNanosecond),
                             std::string(text)});
}

class TrackDecoder {
public:
  explicit TrackDecoder(const std::filesystem::path& file) {
    AVFormatContext* opened = nullptr;
    requireLibav(avformat_open_input(&opened, ("file:" + file.native()).c_str(), nullptr, nullptr), "open");
    format_.reset(opened);
    requireLibav(avformat_find_stream_info(opened, nullptr), "find streams");
  }

  DecodedTracks decode() {
    describe();
    while (true) {
      const int result = av_read_frame(format_.get(), packet_.get());
      if (result == AVERROR_EOF) break;
      requireLibav(result, "read");
      const AVStream& stream = *format_->streams[packet_->stream_index];
      if (stream.codecpar->codec_type == AVMEDIA_TYPE_SUBTITLE) addCue(*packet_, stream, tracks_);
      if (&stream == sound_) feed(packet_.get());
      av_packet_unref(packet_.get());
    }
    if (sound_ != nullptr) feed(nullptr);
    return std::move(tracks_);
  }

private:
  void describe() {
    for (unsigned i = 0; i < format_->nb_streams; ++i) {
      const AVStream& stream = *format_->streams[i];
      tracks_.codecs.emplace_back(avcodec_get_name(stream.codecpar->codec_id));
      if (stream.codecpar->codec_type != AVMEDIA_TYPE_AUDIO) continue;
      sound_ = &stream;
      tracks_.soundCodec = tracks_.codecs.back();
      tracks_.soundRate = stream.codecpar->sample_rate;
      tracks_.soundChannels = stream.codecpar->ch_layout.nb_channels;
      const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
      decoder_.reset(avcodec_alloc_context3(codec));
      requireLibav(avcodec_parameters_to_context(decoder_.get(), stream.codecpar), "codec parameters");
      decoder_->pkt_timebase = stream.time_base;
      requireLibav(avcodec_open2(decoder_.get(), codec, nullptr), "open decoder");
    }
    for (unsigned i = 0; i < format_->nb_chapters; ++i) {
      const AVChapter& chapter = *format_->chapters[i];
      const AVDictionaryEntry* title = av_dict_get(chapter.metadata, "title", nullptr, 0);
      tracks_.chapters.push_back({av_rescale_q(chapter.start, chapter.time_base, kNanosecond),
                                  av_rescale_q(chapter.end, chapter.time_base, kNanosecond),
                                  title == nullptr ? "" : title->value});
    }
  }

  void feed(const AVPacket* packet) {
    requireLibav(avcodec_send_packet(decoder_.get(), packet), "decode");
    while (true) {
      const int result = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      requireLibav(result, "receive");
      place(*frame_, sound_->time_base, tracks_);
    }
  }

  std::unique_ptr<AVFormatContext, LibavFree> format_;
  std::unique_ptr<AVCodecContext, LibavFree> decoder_;
  std::unique_ptr<AVPacket, LibavFree> packet_{av_packet_alloc()};
  std::unique_ptr<AVFrame, LibavFree> frame_{av_frame_alloc()};
  const AVStream* sound_ = nullptr;
  DecodedTracks tracks_;
};

} // namespace

DecodedTracks decodeTracks(const std::filesystem::path& file) {
  return TrackDecoder(file).decode();
}

double onset(const DecodedTracks& tracks, double from, float threshold) {
  for (auto i = static_cast<std::size_t>(from * tracks.soundRate); i < tracks.sound.size(); ++i)
    if (std::abs(tracks.sound[i]) > threshold) return static_cast<double>(i) / tracks.soundRate;
  return -1.0;
}

void writeWav(const std::filesystem::path& file, const std::vector<float>& samples, int rate) {
  std::string data;
  const auto number = [](std::uint32_t value, int size) {
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffU);
    return bytes;
  };
  for (const float sample : samples)
    data += number(static_cast<std::uint32_t>(std::lround(std::clamp(sample, -1.0F, 1.0F) * 32767.0F)), 2);
  const auto perSecond = static_cast<std::uint32_t>(rate);
  writeFile(file, "RIFF" + number(static_cast<std::uint32_t>(36 + data.size()), 4) + "WAVEfmt " +
                      number(16, 4) + number(1, 2) + number(1, 2) + number(perSecond, 4) +
                      number(perSecond * 2, 4) + number(2, 2) + number(16, 2) + "data" +
                      number(static_cast<std::uint32_t>(data.size()), 4) + data);
}

std::vector<float> tone(double frequency, double length, double amplitude, int rate) {
  std::vector<float> samples(static_cast<std::size_t>(std::llround(length * rate)));
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = static_cast<float>(
        amplitude * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / rate));
  return samples;
}

} // namespace offstage::test
