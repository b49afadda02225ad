#include "tests/support/video_decode.h"

#include "tests/support/libav_handles.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace offstage::test {

namespace {

constexpr AVRational kNanosecond{1, 1000000000};
/// The unit of AVFormatContext::duration.
constexpr AVRational kLibavTick{1, AV_TIME_BASE};

std::string nameOr(const char* name) {
  return name == nullptr ? "unknown" : name;
}

std::vector<std::uint8_t> copyPlane(const std::uint8_t* data, int stride, int width, int height) {
  std::vector<std::uint8_t> plane;
  plane.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    const std::uint8_t* begin = data + static_cast<std::ptrdiff_t>(row) * stride;
    plane.insert(plane.end(), begin, begin + width);
  }
  return plane;
}

void receivePictures(AVCodecContext& decoder, AVRational timeBase, AVFrame& frame, DecodedVideo& video) {
  while (true) {
    const int result = avcodec_receive_frame(&decoder, &frame);
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    requireLibav(result, "receive frame");
    if (frame.decode_error_flags != 0) throw std::runtime_error("a frame is damaged");
    DecodedPicture picture;
    picture.start = av_rescale_q(frame.pts, timeBase, kNanosecond);
    picture.keyFrame = frame.key_frame != 0;
    picture.y = copyPlane(frame.data[0], frame.linesize[0], frame.width, frame.height);
    picture.u = copyPlane(frame.data[1], frame.linesize[1], frame.width / 2, frame.height / 2);
    picture.v = copyPlane(frame.data[2], frame.linesize[2], frame.width / 2, frame.height / 2);
    video.pictures.push_back(std::move(picture));
  }
}

void describe(const AVFormatContext& format, const AVStream& stream, DecodedVideo& video) {
  const AVCodecParameters& codec = *stream.codecpar;
  video.codec = avcodec_get_name(codec.codec_id);
  video.profile = nameOr(avcodec_profile_name(codec.codec_id, codec.profile));
  video.pixelFormat = nameOr(av_get_pix_fmt_name(static_cast<AVPixelFormat>(codec.format)));
  video.primaries = nameOr(av_color_primaries_name(codec.color_primaries));
  video.transfer = nameOr(av_color_transfer_name(codec.color_trc));
  video.matrix = nameOr(av_color_space_name(codec.color_space));
  video.range = nameOr(av_color_range_name(codec.color_range));
  video.chromaLocation = nameOr(av_chroma_location_name(codec.chroma_location));
  const AVDictionaryEntry* title = av_dict_get(format.metadata, "title", nullptr, 0);
  if (title != nullptr) video.title = title->value;
  video.width = codec.width;
  video.height = codec.height;
  video.averageRate = av_q2d(stream.avg_frame_rate);
  video.duration = av_rescale_q(format.duration, kLibavTick, kNanosecond);
  video.streamDuration =
      stream.duration == AV_NOPTS_VALUE ? -1 : av_rescale_q(stream.duration, stream.time_base, kNanosecond);
}

/// Linear interpolation of a chroma plane at a luma sample: sited on even columns, between rows.
double chromaAt(const std::vector<std::uint8_t>& plane, int width, int height, int row, int column) {
  const double x = column / 2.0;
  const double y = (row - 0.5) / 2.0;
  const auto sample = [&](double r, double c) {
    const int clampedRow = std::clamp(static_cast<int>(r), 0, height - 1);
    const int clampedColumn = std::clamp(static_cast<int>(c), 0, width - 1);
    return static_cast<double>(plane[pixelIndex(clampedRow, width, clampedColumn)]);
  };
  const double x0 = std::floor(x);
  const double y0 = std::floor(y);
  const double fx = x - x0;
  const double fy = y - y0;
  const double upper = sample(y0, x0) * (1.0 - fx) + sample(y0, x0 + 1.0) * fx;
  const double lower = sample(y0 + 1.0, x0) * (1.0 - fx) + sample(y0 + 1.0, x0 + 1.0) * fx;
  return upper * (1.0 - fy) + lower * fy;
}

std::uint8_t toByte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

} // namespace

DecodedVideo decodeVideo(const std::filesystem::path& file) {
  AVFormatContext* opened = nullptr;
  requireLibav(avformat_open_input(&opened, ("file:" + file.native()).c_str(), nullptr, nullptr), "open");
  const std::unique_ptr<AVFormatContext, LibavFree> format(opened);
  requireLibav(avformat_find_stream_info(format.get(), nullptr), "find streams");
  if (format->nb_streams != 1) throw std::runtime_error("not exactly one stream");
  const AVStream& stream = *format->streams[0];
  DecodedVideo video;
  describe(*format, stream, video);

  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  const std::unique_ptr<AVCodecContext, LibavFree> decoder(avcodec_alloc_context3(codec));
  requireLibav(avcodec_parameters_to_context(decoder.get(), stream.codecpar), "codec parameters");
  decoder->err_recognition = AV_EF_EXPLODE;
  decoder->pkt_timebase = stream.time_base;
  requireLibav(avcodec_open2(decoder.get(), codec, nullptr), "open decoder");

  const std::unique_ptr<AVPacket, LibavFree> packet(av_packet_alloc());
  const std::unique_ptr<AVFrame, LibavFree> frame(av_frame_alloc());
  while (true) {
    const int result = av_read_frame(format.get(), packet.get());
    if (result == AVERROR_EOF) break;
    requireLibav(result, "read");
    video.decodeTimes.push_back(av_rescale_q(packet->dts, stream.time_base, kNanosecond));
    requireLibav(avcodec_send_packet(decoder.get(), packet.get()), "decode");
    av_packet_unref(packet.get());
    receivePictures(*decoder, stream.time_base, *frame, video);
  }
  requireLibav(avcodec_send_packet(decoder.get(), nullptr), "flush");
  receivePictures(*decoder, stream.time_base, *frame, video);
  return video;
}

Frame toRgb(const DecodedVideo& video, std::size_t index) {
  const DecodedPicture& picture = video.pictures.at(index);
  Frame frame;
  frame.width = video.width;
  frame.height = video.height;
  frame.rgba.reserve(picture.y.size() * 4);
  for (int row = 0; row < video.height; ++row) {
    for (int column = 0; column < video.width; ++column) {
      const double y = (picture.y[pixelIndex(row, video.width, column)] - 16.0) / 219.0;
      const double cb = (chromaAt(picture.u, video.width / 2, video.height / 2, row, column) - 128.0) / 224.0;
      const double cr = (chromaAt(picture.v, video.width / 2, video.height / 2, row, column) - 128.0) / 224.0;
      const double red = y + 1.5748 * cr;
      const double blue = y + 1.8556 * cb;
      const double green = (y - 0.2126 * red - 0.0722 * blue) / 0.7152;
      frame.rgba.insert(frame.rgba.end(),
                        {toByte(255.0 * red), toByte(255.0 * green), toByte(255.0 * blue), 255});
    }
  }
  return frame;
}

double meanAbsoluteError(const Frame& a, const Frame& b) {
  const int width = std::min(a.width, b.width);
  const int height = std::min(a.height, b.height);
  double sum = 0.0;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (std::size_t c = 0; c < 3; ++c) {
        sum += std::abs(a.rgba[pixelIndex(row, a.width, column) * 4 + c] -
                        b.rgba[pixelIndex(row, b.width, column) * 4 + c]);
      }
    }
  }
  return sum / (3.0 * width * height);
}

std::vector<std::string> topLevelBoxes(const std::filesystem::path& file) {
  const std::string bytes = readFile(file);
  const auto number = [&bytes](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8U | static_cast<std::uint8_t>(bytes.at(at + i));
    return value;
  };
  std::vector<std::string> types;
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint64_t size = number(at, 4);
    types.push_back(bytes.substr(at + 4, 4));
    if (size == 1) size = number(at + 8, 8); // ISO/IEC 14496-12, 4.2: largesize
    if (size < 8 || size > bytes.size() - at)
      throw std::runtime_error("a box of an impossible size: " + types.back());
    at += size;
  }
  return types;
}

} // namespace offstage::test
