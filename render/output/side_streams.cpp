#include "render/output/side_streams.h"

#include "render/output/captions.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace offstage {
namespace {

constexpr AVRational kNanosecond{1, 1000000000};
constexpr AVRational kMillisecond{1, 1000};

bool isMov(Container container) {
  return container == Container::Mp4 || container == Container::Mov;
}

/// The sample description of 3GPP timed text (3GPP TS 26.245, 5.16), without its box's head: centred at the
/// bottom, white, 18 px, in the font "Sans".
constexpr std::array<std::uint8_t, 47> kTextDescription{
    0,    0,    0,    0,                       // display flags
    1,    0xff,                                // horizontally centred, vertically at the bottom
    0,    0,    0,    0,                       // background: transparent
    0,    0,    0,    0,    0,   0,   0,   0,  // text box: all of the track
    0,    0,    0,    0,    0,   1,   0,   18, // style: of no characters, font 1, plain, 18 px
    0xff, 0xff, 0xff, 0xff,                    // … white
    0,    0,    0,    17,   'f', 't', 'a', 'b', 0, 1, 0, 1, 4, 'S', 'a', 'n', 's'};

libav::Packet packetOf(std::string_view bytes, std::int64_t start, std::int64_t end) {
  libav::Packet packet = libav::makePacket();
  libav::check(av_new_packet(packet.get(), static_cast<int>(bytes.size())), ExitCode::Transient,
               "no memory for a caption");
  std::memcpy(packet->data, bytes.data(), bytes.size());
  packet->pts = start;
  packet->dts = start;
  packet->duration = end - start;
  packet->flags |= AV_PKT_FLAG_KEY;
  return packet;
}

/// A text's length in two bytes, highest first, and the text (3GPP TS 26.245, 5.17).
std::string movTextOf(std::string_view text) {
  std::string sample{static_cast<char>(text.size() >> 8U), static_cast<char>(text.size() & 0xffU)};
  return sample.append(text);
}

} // namespace

SoundCodec soundCodecOf(Container container) {
  return isMov(container) ? SoundCodec::Aac : SoundCodec::Opus;
}

SideStreams::SideStreams(Container container, const VideoTracks& tracks, int width, int height)
    : chapters_(tracks.chapters) {
  if (tracks.sound) {
    const std::int64_t samples = av_rescale_q(tracks.end, kNanosecond, {1, kSoundRate});
    EncodedSound sound = encodeSound(*tracks.sound, samples, soundCodecOf(container));
    // Matroska counts Opus from the beginning of its run-up, whose length stands in the header (CodecDelay);
    // .mp4 has an edit list, and times before 0.
    if (!isMov(container))
      for (const libav::Packet& packet : sound.packets) {
        packet->pts += sound.parameters->initial_padding;
        packet->dts += sound.parameters->initial_padding;
      }
    streams_.push_back({std::move(sound.parameters), sound.timeBase, std::move(sound.packets)});
  }
  if (!tracks.captions.empty()) addCaptions(isMov(container), tracks, width, height);
}

void SideStreams::addCaptions(bool movText, const VideoTracks& tracks, int width, int height) {
  Stream& stream = streams_.emplace_back();
  stream.timeBase = kMillisecond;
  stream.parameters.reset(libav::allocated(avcodec_parameters_alloc()));
  AVCodecParameters& parameters = *stream.parameters;
  parameters.codec_type = AVMEDIA_TYPE_SUBTITLE;
  parameters.codec_id = movText ? AV_CODEC_ID_MOV_TEXT : AV_CODEC_ID_WEBVTT;
  if (movText) {
    parameters.codec_tag = MKTAG('t', 'x', '3', 'g');
    parameters.width = width;
    parameters.height = height;
    parameters.extradata = static_cast<std::uint8_t*>(
        libav::allocated(av_mallocz(kTextDescription.size() + AV_INPUT_BUFFER_PADDING_SIZE)));
    std::ranges::copy(kTextDescription, parameters.extradata);
    parameters.extradata_size = static_cast<int>(kTextDescription.size());
  }
  for (const Cue& cue : movText ? withoutOverlaps(tracks.captions, tracks.end) : tracks.captions) {
    const std::int64_t from = av_rescale_q(std::min(cue.start, tracks.end), kNanosecond, kMillisecond);
    // None outlasts the pictures: a player takes the longest stream for the film's length.
    const std::int64_t to = std::min(av_rescale_q(cue.end, kNanosecond, kMillisecond),
                                     av_rescale_q_rnd(tracks.end, kNanosecond, kMillisecond, AV_ROUND_DOWN));
    if (from < to)
      stream.packets.push_back(packetOf(movText ? movTextOf(cue.text) : webVttText(cue.text), from, to));
  }
}

void SideStreams::addTo(AVFormatContext& format) {
  for (Stream& stream : streams_) {
    AVStream& added = *libav::allocated(avformat_new_stream(&format, nullptr));
    libav::check(avcodec_parameters_copy(added.codecpar, stream.parameters.get()), ExitCode::Transient,
                 "cannot describe a stream");
    added.time_base = stream.timeBase;
    stream.index = added.index;
  }
  if (chapters_.empty()) return;
  format.chapters =
      static_cast<AVChapter**>(libav::allocated(av_calloc(chapters_.size(), sizeof(AVChapter*))));
  for (const Chapter& chapter : chapters_) {
    auto* added = static_cast<AVChapter*>(libav::allocated(av_mallocz(sizeof(AVChapter))));
    format.chapters[format.nb_chapters++] = added;
    added->id = format.nb_chapters;
    added->time_base = kMillisecond;
    added->start = av_rescale_q(chapter.start, kNanosecond, kMillisecond);
    added->end = av_rescale_q(chapter.end, kNanosecond, kMillisecond);
    libav::check(av_dict_set(&added->metadata, "title", chapter.title.c_str(), 0), ExitCode::Transient,
                 "no memory for a chapter");
  }
}

std::int64_t SideStreams::startOf(const Stream& stream) {
  if (stream.next == stream.packets.size()) return std::numeric_limits<std::int64_t>::max();
  return av_rescale_q(stream.packets[stream.next]->pts, stream.timeBase, kNanosecond);
}

int SideStreams::writeNext(AVFormatContext& format, Stream& stream) {
  AVPacket& packet = *stream.packets[stream.next++];
  packet.stream_index = stream.index;
  av_packet_rescale_ts(&packet, stream.timeBase, format.streams[stream.index]->time_base);
  const int result = av_write_frame(&format, &packet);
  av_packet_unref(&packet);
  return result;
}

int SideStreams::writeUntil(AVFormatContext& format, std::int64_t time) {
  while (!streams_.empty()) {
    Stream& first = *std::ranges::min_element(streams_, {}, startOf);
    if (startOf(first) >= time) break;
    if (const int result = writeNext(format, first); result < 0) return result;
  }
  return 0;
}

int SideStreams::writeRest(AVFormatContext& format) {
  return writeUntil(format, std::numeric_limits<std::int64_t>::max());
}

} // namespace offstage
