#include "render/output/verify.h"

#include "render/output/file_error.h"
#include "render/output/frame_decoder.h"
#include "render/output/input_file.h"
#include "render/output/packet_hash.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

#include <fmt/format.h>

extern "C" {
#include <libavutil/mathematics.h>
#include <libavutil/pixdesc.h>
}

namespace offstage {

namespace {

/// The unit of AVFormatContext::duration.
constexpr AVRational kLibavTick{1, AV_TIME_BASE};
/// The coarsest unit of the containers: .mkv's.
constexpr AVRational kMillisecond{1, 1000};
/// s: the longest packet of the sound codecs (AAC: 1024 samples at 48 kHz), and a millisecond.
constexpr double kSoundPacket = 0.0225;

/// libav's names may be null for numbers that it does not know.
std::string_view nameOr(const char* name) {
  return name == nullptr ? "unknown" : name;
}

class Verifier {
public:
  Verifier(const std::filesystem::path& file, const ExpectedVideo& expected,
           const std::filesystem::path& name)
      : expected_(expected),
        name_(name),
        failing_([this](std::string_view why) { fail(why); }),
        packet_(libav::makePacket()),
        first_(libav::makePacket()),
        last_(libav::makePacket()) {
    check(libav::openInput(file, format_), "it cannot be opened again");
    // avformat_find_stream_info() would decode up to twenty frames to guess what the decoder tells us anyway.
    findStream();
  }

  void run() {
    readAll();
    if (!decodeEndsTogether()) {
      decodeFirst();
      decodeLast();
    }
    if (!differences_.empty()) fail(differences_);
  }

private:
  /// The one video stream; the others are not read (verifyTracks).
  void findStream() {
    int videos = 0;
    for (unsigned i = 0; i < format_->nb_streams; ++i) {
      AVStream& stream = *format_->streams[i];
      const bool isVideo = stream.codecpar->codec_type == AVMEDIA_TYPE_VIDEO;
      if (isVideo)
        stream_ = &stream;
      else
        stream.discard = AVDISCARD_ALL;
      videos += isVideo ? 1 : 0;
    }
    if (videos != 1) fail(fmt::format("it has {} video streams instead of 1", videos));
  }

  [[noreturn]] void fail(std::string_view why) const {
    throw Error(ExitCode::Transient,
                fmt::format("the check of the finished {} failed: {}", quoted(name_), why));
  }

  int check(int result, std::string_view what) const {
    return libav::check(result, ExitCode::Transient,
                        fmt::format("the check of the finished {} failed: {}", quoted(name_), what));
  }

  template <class Found, class Wanted>
  void compare(std::string_view what, const Found& found, const Wanted& wanted) {
    if (found == wanted) return;
    if (!differences_.empty()) differences_ += "; ";
    differences_ += fmt::format("{} {} instead of {}", what, found, wanted);
  }

  /// What the container says, and what the decoder has found in the first frame.
  void compareStream(const AVCodecContext& found) {
    const AVCodecParameters& stream = *stream_->codecpar;
    const CodecTraits& traits = traitsOf(expected_.codec);
    compare("codec", std::string_view(avcodec_get_name(stream.codec_id)), std::string_view(traits.decoded));
    if (traits.profile != nullptr)
      compare("profile", nameOr(avcodec_profile_name(stream.codec_id, found.profile)),
              std::string_view(traits.profile));
    compare("width", stream.width, expected_.width);
    compare("height", stream.height, expected_.height);
    compare("decoded width", found.width, expected_.width);
    compare("decoded height", found.height, expected_.height);
    compare("pixel format", nameOr(av_get_pix_fmt_name(found.pix_fmt)),
            std::string_view(av_get_pix_fmt_name(traits.read)));
    compareColour(found, traits);
    compareTime("duration", format_->duration, kLibavTick, expected_.end,
                expected_.hasSound ? kSoundPacket : 0.0);
  }

  void compareColour(const AVCodecContext& found, const CodecTraits& traits) {
    compare("primaries", nameOr(av_color_primaries_name(found.color_primaries)), std::string_view("bt709"));
    compare("transfer", nameOr(av_color_transfer_name(found.color_trc)),
            std::string_view(traits.rgb ? "iec61966-2-1" : "bt709"));
    compare("matrix", nameOr(av_color_space_name(found.colorspace)),
            std::string_view(traits.rgb ? "gbr" : "bt709"));
    compare("range", nameOr(av_color_range_name(found.color_range)),
            std::string_view(traits.rgb ? "pc" : "tv"));
    if (traits.subsampled)
      compare("chroma location", nameOr(av_chroma_location_name(found.chroma_sample_location)),
              std::string_view("left"));
  }

  void compareTime(std::string_view what, std::int64_t found, AVRational foundBase, std::int64_t wanted,
                   double atLeast = 0.0) {
    const double tolerance =
        std::max({av_q2d(foundBase), av_q2d(stream_->time_base), av_q2d(kMillisecond), atLeast});
    const double difference = static_cast<double>(found) * av_q2d(foundBase) -
                              static_cast<double>(wanted) * av_q2d(expected_.timeBase);
    if (std::abs(difference) <= tolerance * (1.0 + 1e-6))
      return; // the factor is for the doubles' own rounding
    compare(what, fmt::format("{:.6f} s", static_cast<double>(found) * av_q2d(foundBase)),
            fmt::format("{:.6f} s", static_cast<double>(wanted) * av_q2d(expected_.timeBase)));
  }

  /// Every packet of the file; the one of the first frame is kept, and that of the last.
  void readAll() {
    std::int64_t frames = 0;
    PacketHash packets;
    for (; readPacket(); av_packet_unref(packet_.get())) {
      packets.addStored(*packet_);
      if (++frames == 1) keep(first_);
      if (packet_->pts <= lastStart_) continue;
      lastStart_ = packet_->pts;
      keep(last_);
    }
    compare("number of frames", frames, expected_.frames);
    if (frames == 0) fail("it has no frames");
    compare("hash of the packets", fmt::format("{:016x}", packets.value()),
            fmt::format("{:016x}", expected_.packets));
    compareTime("start", first_->pts, stream_->time_base, 0);
    compareTime("start of the last frame", lastStart_, stream_->time_base, expected_.lastStart);
  }

  void keep(libav::Packet& copy) {
    av_packet_unref(copy.get());
    check(av_packet_ref(copy.get(), packet_.get()), "a frame cannot be kept");
  }

  /// Whether the first and the last frame decode one after the other. Of H.264 they do: the decoder takes the
  /// first for the references that are not there. That those are what was encoded is known from their hash;
  /// to decode the last chunk of a film of thousands of bodies takes a quarter of a second.
  bool decodeEndsTogether() {
    if (stream_->codecpar->codec_id != AV_CODEC_ID_H264) return false;
    FrameDecoder decoder(*stream_, failing_);
    decoder.silence(); // it complains of what is not there
    try {
      decoder.decode(first_.get());
      if (lastStart_ != first_->pts) decoder.decode(last_.get());
      decoder.decode(nullptr);
    } catch (const Error&) { // each for itself will tell
      return false;
    }
    if (decoder.first() != first_->pts || decoder.last() != lastStart_) return false;
    compareStream(decoder.context());
    return true;
  }

  void decodeFirst() {
    FrameDecoder decoder(*stream_, failing_);
    // Nothing behind it: a decoder of B-frames gives the first away only with later ones, which take time
    // too.
    const bool decoded = decoder.decode(first_.get()) || decoder.decode(nullptr);
    if (!decoded || decoder.first() != first_->pts) fail("its first frame does not decode");
    compareStream(decoder.context());
  }

  /// With all that it rests on.
  void decodeLast() {
    FrameDecoder decoder(*stream_, failing_);
    check(av_seek_frame(format_.get(), stream_->index, lastStart_, AVSEEK_FLAG_BACKWARD),
          "its last frame is not found");
    for (; readPacket(); av_packet_unref(packet_.get())) decoder.decode(packet_.get());
    decoder.decode(nullptr);
    if (decoder.last() != lastStart_) fail("its last frame does not decode");
  }

  /// The next packet of the video.
  bool readPacket() {
    while (true) {
      const int result = av_read_frame(format_.get(), packet_.get());
      if (result == AVERROR_EOF) return false;
      check(result, "it cannot be read to the end");
      if (packet_->stream_index == stream_->index) return true;
      av_packet_unref(packet_.get());
    }
  }

  const ExpectedVideo& expected_;
  const std::filesystem::path& name_;
  FrameDecoder::Fail failing_;
  libav::InputContext format_;
  AVStream* stream_ = nullptr;
  libav::Packet packet_;
  libav::Packet first_, last_;
  std::int64_t lastStart_ = AV_NOPTS_VALUE;
  std::string differences_;
};

} // namespace

void verifyVideo(const std::filesystem::path& file, const ExpectedVideo& expected,
                 const std::filesystem::path& name) {
  Verifier(file, expected, name).run();
}

} // namespace offstage
