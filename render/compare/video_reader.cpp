#include "render/compare/video_reader.h"

#include "render/compare/yuv_rows.h"
#include "render/output/file_error.h"

#include <cstring>

#include <fmt/format.h>

extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace offstage {
namespace {

/// From so many rows on a video that names no matrix is taken for BT.709.
constexpr int kHighDefinition = 720;

} // namespace

VideoReader::VideoReader(const std::filesystem::path& file, std::int64_t maxPixels, int threads)
    : file_(file), maxPixels_(maxPixels), packet_(libav::makePacket()) {
  libav::quietLog(AV_LOG_FATAL);
  AVFormatContext* format = nullptr;
  check(avformat_open_input(&format, ("file:" + file.native()).c_str(), nullptr, nullptr), "cannot be read");
  format_.reset(format);
  check(avformat_find_stream_info(format, nullptr), "has no streams that are recognised");
  stream_ = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream_ < 0) fail("holds no video");
  const AVCodecParameters& codec = *format->streams[stream_]->codecpar;
  requireAllowedSize(codec.width, codec.height);
  openDecoder(threads);
}

void VideoReader::fail(const std::string& why) const {
  throw Error(ExitCode::BadInput, fmt::format("{} {}", quoted(file_), why));
}

int VideoReader::check(int result, const char* what) const {
  if (result < 0) fail(fmt::format("{}: {}", what, libav::errorText(result)));
  return result;
}

void VideoReader::requireAllowedSize(int width, int height) const {
  if (static_cast<std::int64_t>(width) * height > maxPixels_)
    fail(fmt::format("has frames of {}x{} px, more than the limit of {} pixels", width, height, maxPixels_));
}

void VideoReader::openDecoder(int threads) {
  const AVStream& stream = *format_->streams[stream_];
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr)
    throw Error(ExitCode::Environment,
                fmt::format("{} is {}, which libavcodec cannot decode here: install the Debian package "
                            "libavcodec-extra59",
                            quoted(file_), avcodec_get_name(stream.codecpar->codec_id)));
  decoder_.reset(libav::allocated(avcodec_alloc_context3(codec)));
  check(avcodec_parameters_to_context(decoder_.get(), stream.codecpar), "does not describe its codec");
  decoder_->pkt_timebase = stream.time_base;
  decoder_->thread_count = threads;
  decoder_->err_recognition = AV_EF_EXPLODE | AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER;
  check(avcodec_open2(decoder_.get(), codec, nullptr), "cannot be decoded");
}

/// Hands the decoder one packet, or the end. False when the end was handed over before.
bool VideoReader::feed() {
  if (drained_) return false;
  while (true) {
    const int result = av_read_frame(format_.get(), packet_.get());
    if (result == AVERROR_EOF) {
      if (format_->pb != nullptr && format_->pb->error < 0)
        fail(fmt::format("cannot be read: {}", libav::errorText(format_->pb->error)));
      drained_ = true;
      check(avcodec_send_packet(decoder_.get(), nullptr), "cannot be decoded to its end");
      return true;
    }
    check(result, "is damaged");
    const bool wanted = packet_->stream_index == stream_;
    if (wanted && (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0) fail("is damaged or cut off");
    if (wanted) noteExactTime();
    const int sent = wanted ? avcodec_send_packet(decoder_.get(), packet_.get()) : 0;
    av_packet_unref(packet_.get());
    check(sent, "is damaged");
    if (wanted) return true;
  }
}

/// libav rounds what each frame of an .apng lasts to hundred-thousandths of a second and adds that up: 12 ms
/// a minute at 60 frames a second. The fraction itself stands in front of the frame's data (APNG 1.0, fcTL).
void VideoReader::noteExactTime() {
  constexpr int kDelay = 28; // from the chunk's length on: 2 bytes each of numerator and denominator
  const AVPacket& packet = *packet_;
  if (decoder_->codec_id != AV_CODEC_ID_APNG || packet.size < kDelay + 4 ||
      std::memcmp(packet.data + 4, "fcTL", 4) != 0)
    return;
  exactTimes_[packet.pts] = apngTime_;
  const int numerator = packet.data[kDelay] << 8 | packet.data[kDelay + 1];
  const int denominator = packet.data[kDelay + 2] << 8 | packet.data[kDelay + 3];
  if (numerator == 0) // as long as the reader likes
    apngTime_ += static_cast<double>(packet.duration) * av_q2d(format_->streams[stream_]->time_base);
  else
    apngTime_ += static_cast<double>(numerator) / (denominator == 0 ? 100 : denominator);
}

std::shared_ptr<const VideoPicture> VideoReader::next() {
  auto picture = std::make_shared<VideoPicture>();
  picture->frame = libav::makeFrame();
  while (true) {
    const int result = avcodec_receive_frame(decoder_.get(), picture->frame.get());
    if (result == AVERROR_EOF) return nullptr;
    if (result == AVERROR(EAGAIN)) {
      if (!feed()) return nullptr;
      continue;
    }
    check(result, "is damaged");
    const AVFrame& frame = *picture->frame;
    if (frame.decode_error_flags != 0) fail("is damaged");
    requireAllowedSize(frame.width, frame.height);
    const AVStream& stream = *format_->streams[stream_];
    const std::int64_t start = stream.start_time == AV_NOPTS_VALUE ? 0 : stream.start_time;
    const std::int64_t shown =
        frame.best_effort_timestamp == AV_NOPTS_VALUE ? start : frame.best_effort_timestamp;
    const auto exact = exactTimes_.find(shown);
    picture->time =
        exact != exactTimes_.end() ? exact->second : static_cast<double>(shown) * av_q2d(stream.time_base);
    if (exact != exactTimes_.end()) exactTimes_.erase(exact);
    return picture;
  }
}

bool equalPictures(const VideoPicture& first, const VideoPicture& second) {
  const AVFrame& a = *first.frame;
  const AVFrame& b = *second.frame;
  if (a.width != b.width || a.height != b.height || a.format != b.format || a.colorspace != b.colorspace ||
      a.color_range != b.color_range || a.chroma_location != b.chroma_location)
    return false;
  const auto format = static_cast<AVPixelFormat>(a.format);
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  if (description == nullptr || (description->flags & AV_PIX_FMT_FLAG_HWACCEL) != 0) return false;
  if ((description->flags & AV_PIX_FMT_FLAG_PAL) != 0) {
    constexpr std::size_t kPalette = 1024; // bytes
    if (std::memcmp(a.data[1], b.data[1], kPalette) != 0) return false;
  }
  for (int plane = 0; plane < av_pix_fmt_count_planes(format); ++plane) {
    const int bytes = av_image_get_linesize(format, a.width, plane);
    const bool chroma = plane == 1 || plane == 2;
    const int rows = chroma ? AV_CEIL_RSHIFT(a.height, description->log2_chroma_h) : a.height;
    if ((description->flags & AV_PIX_FMT_FLAG_PAL) != 0 && plane > 0) break;
    for (int row = 0; row < rows; ++row) {
      if (std::memcmp(a.data[plane] + static_cast<std::ptrdiff_t>(row) * a.linesize[plane],
                      b.data[plane] + static_cast<std::ptrdiff_t>(row) * b.linesize[plane],
                      static_cast<std::size_t>(bytes)) != 0)
        return false;
    }
  }
  return true;
}

struct VideoConverter::Scaler {
  ~Scaler() { sws_freeContext(context); }
  SwsContext* context = nullptr;
};

VideoConverter::VideoConverter() : scaler_(std::make_unique<Scaler>()) {}
VideoConverter::~VideoConverter() = default;

const Frame& VideoConverter::convert(const VideoPicture& picture) {
  const AVFrame& from = *picture.frame;
  const bool matrixKnown = from.colorspace == AVCOL_SPC_BT709 || from.colorspace == AVCOL_SPC_BT470BG ||
                           from.colorspace == AVCOL_SPC_SMPTE170M || from.colorspace == AVCOL_SPC_UNSPECIFIED;
  const bool leftChroma =
      from.chroma_location == AVCHROMA_LOC_LEFT || from.chroma_location == AVCHROMA_LOC_UNSPECIFIED;
  const bool usual = from.format == AV_PIX_FMT_YUV420P || from.format == AV_PIX_FMT_YUVJ420P;
  if (!usual || !matrixKnown || !leftChroma) {
    scale(picture);
    return frame_;
  }
  // What nearly every video is, several times faster than swscale's exact way.
  const bool full = from.color_range == AVCOL_RANGE_JPEG || from.format == AV_PIX_FMT_YUVJ420P;
  const bool high = from.colorspace == AVCOL_SPC_BT709 ||
                    (from.colorspace == AVCOL_SPC_UNSPECIFIED && from.height >= kHighDefinition);
  toRgba({from.width, from.height, from.data[0], from.data[1], from.data[2], from.linesize[0],
          from.linesize[1], from.linesize[2], full, high},
         frame_);
  return frame_;
}

void VideoConverter::scale(const VideoPicture& picture) {
  const AVFrame& from = *picture.frame;
  // Exact rather than fast: chroma is interpolated, and every step rounds.
  constexpr int kFlags = SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_BITEXACT;
  scaler_->context =
      sws_getCachedContext(scaler_->context, from.width, from.height, static_cast<AVPixelFormat>(from.format),
                           from.width, from.height, AV_PIX_FMT_RGBA, kFlags, nullptr, nullptr, nullptr);
  if (scaler_->context == nullptr)
    throw Error(ExitCode::BadInput,
                fmt::format("pictures in the pixel format {} cannot be compared",
                            av_get_pix_fmt_name(static_cast<AVPixelFormat>(from.format))));
  const bool named = from.colorspace != AVCOL_SPC_UNSPECIFIED && from.colorspace != AVCOL_SPC_RGB;
  const int unnamed = from.height >= kHighDefinition ? SWS_CS_ITU709 : SWS_CS_ITU601;
  const int* matrix = sws_getCoefficients(named ? static_cast<int>(from.colorspace) : unnamed);
  constexpr int kOne = 1 << 16; // contrast and saturation as they are
  sws_setColorspaceDetails(scaler_->context, matrix, from.color_range == AVCOL_RANGE_JPEG ? 1 : 0,
                           sws_getCoefficients(SWS_CS_ITU709), 1, 0, kOne, kOne);
  frame_.width = from.width;
  frame_.height = from.height;
  frame_.rgba.resize(4UL * static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height));
  std::uint8_t* const to[] = {frame_.rgba.data()};
  const int stride[] = {4 * from.width};
  sws_scale(scaler_->context, from.data, from.linesize, 0, from.height, to, stride);
}

} // namespace offstage
