#include "render/output/verify.h"

#include "render/output/file_error.h"
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
      : expected_(expected), name_(name), packet_(libav::makePacket()), frame_(libav::makeFrame()) {
    check(libav::openInput(file, format_), "it cannot be opened again");
    // avformat_find_stream_info() would decode up to twenty frames to guess what the decoder tells us anyway.
    findStream();
    openDecoder();
  }

  void run() {
    readAll();
    compareStream();
    decodeLast();
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

  void openDecoder() {
    const AVCodec* codec = avcodec_find_decoder(stream_->codecpar->codec_id);
    if (codec == nullptr) {
      throw Error(ExitCode::Environment, "libavcodec has no decoder to check the finished video with: "
                                         "install the Debian package libavcodec59");
    }
    decoder_.reset(libav::allocated(avcodec_alloc_context3(codec)));
    check(avcodec_parameters_to_context(decoder_.get(), stream_->codecpar), "its codec is not described");
    decoder_->pkt_timebase = stream_->time_base;
    decoder_->thread_count = 1;
    // Nobody looks at the pictures: what smooths them is time lost.
    decoder_->skip_loop_filter = AVDISCARD_ALL;
    check(avcodec_open2(decoder_.get(), codec, nullptr), "its decoder does not open");
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
  void compareStream() {
    const AVCodecParameters& stream = *stream_->codecpar;
    const CodecTraits& traits = traitsOf(expected_.codec);
    compare("codec", std::string_view(avcodec_get_name(stream.codec_id)), std::string_view(traits.decoded));
    if (traits.profile != nullptr)
      compare("profile", nameOr(avcodec_profile_name(stream.codec_id, decoder_->profile)),
              std::string_view(traits.profile));
    compare("width", stream.width, expected_.width);
    compare("height", stream.height, expected_.height);
    compare("decoded width", decoder_->width, expected_.width);
    compare("decoded height", decoder_->height, expected_.height);
    compare("pixel format", nameOr(av_get_pix_fmt_name(decoder_->pix_fmt)),
            std::string_view(av_get_pix_fmt_name(traits.read)));
    compareColour(*decoder_, traits);
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

  /// Every packet of the file; the first frame on the way.
  void readAll() {
    std::int64_t frames = 0;
    std::int64_t first = AV_NOPTS_VALUE;
    bool decoded = false;
    PacketHash packets;
    while (readPacket()) {
      ++frames;
      packets.addStored(*packet_);
      lastStart_ = std::max(lastStart_, packet_->pts);
      if (first == AV_NOPTS_VALUE) {
        first = packet_->pts;
        // At once: a decoder of B-frames gives the first away only with later ones, which take time too.
        decoded = decode(packet_.get()) || decode(nullptr);
      }
      av_packet_unref(packet_.get());
    }
    compare("number of frames", frames, expected_.frames);
    if (frames == 0 || !decoded || firstDecoded_ != first) fail("its first frame does not decode");
    compare("hash of the packets", fmt::format("{:016x}", packets.value()),
            fmt::format("{:016x}", expected_.packets));
    compareTime("start", first, stream_->time_base, 0);
    compareTime("start of the last frame", lastStart_, stream_->time_base, expected_.lastStart);
  }

  void decodeLast() {
    check(av_seek_frame(format_.get(), stream_->index, lastStart_, AVSEEK_FLAG_BACKWARD),
          "its last frame is not found");
    avcodec_flush_buffers(decoder_.get());
    lastDecoded_ = AV_NOPTS_VALUE;
    while (readPacket()) {
      if (packet_->pts == lastStart_ || leadsToLast()) decode(packet_.get());
      av_packet_unref(packet_.get());
    }
    decode(nullptr);
    if (lastDecoded_ != lastStart_) fail("its last frame does not decode");
  }

  /// Whether the last frame needs the packet, which comes before it. Of H.264 it decodes with the key frame
  /// alone, which the decoder takes for the references that are not there. That those are what was encoded is
  /// known from their hash; to decode the last chunk of a film of thousands of bodies takes a quarter of a
  /// second.
  [[nodiscard]] bool leadsToLast() const {
    return stream_->codecpar->codec_id != AV_CODEC_ID_H264 || (packet_->flags & AV_PKT_FLAG_KEY) != 0;
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

  /// Whether a frame came out. A null packet asks for what the decoder still holds.
  bool decode(const AVPacket* packet) {
    check(avcodec_send_packet(decoder_.get(), packet), "a frame does not decode");
    bool any = false;
    while (true) {
      const int result = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return any;
      check(result, "a frame does not decode");
      if (frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0)
        fail("a frame is damaged");
      any = true;
      if (firstDecoded_ == AV_NOPTS_VALUE) firstDecoded_ = frame_->pts;
      lastDecoded_ = std::max(lastDecoded_, frame_->pts);
    }
  }

  const ExpectedVideo& expected_;
  const std::filesystem::path& name_;
  libav::InputContext format_;
  AVStream* stream_ = nullptr;
  libav::CodecContext decoder_;
  libav::Packet packet_;
  libav::VideoFrame frame_;
  std::int64_t lastStart_ = AV_NOPTS_VALUE;
  std::int64_t firstDecoded_ = AV_NOPTS_VALUE;
  std::int64_t lastDecoded_ = AV_NOPTS_VALUE;
  std::string differences_;
};

} // namespace

void verifyVideo(const std::filesystem::path& file, const ExpectedVideo& expected,
                 const std::filesystem::path& name) {
  Verifier(file, expected, name).run();
}

} // namespace offstage
