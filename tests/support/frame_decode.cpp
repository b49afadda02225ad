#include "tests/support/frame_decode.h"

#include "tests/support/libav_handles.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace offstage::test {
namespace {

void require(bool good, const std::string& what) {
  if (!good) throw std::runtime_error(what);
}

/// Components 0, 1, 2 (and 3, where there is one) of a pixel, as FFmpeg describes the format.
std::array<int, 4> componentsAt(const AVFrame& frame, int row, int column) {
  const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  std::array<int, 4> values{0, 0, 0, -1};
  for (int i = 0; i < format.nb_components; ++i) {
    const AVComponentDescriptor& part = format.comp[i];
    const bool chroma = (i == 1 || i == 2) && (format.flags & AV_PIX_FMT_FLAG_RGB) == 0;
    const int x = chroma ? column >> format.log2_chroma_w : column;
    const int y = chroma ? row >> format.log2_chroma_h : row;
    const std::uint8_t* at = frame.data[part.plane] +
                             static_cast<std::ptrdiff_t>(y) * frame.linesize[part.plane] +
                             static_cast<std::ptrdiff_t>(x) * part.step + part.offset;
    const int sample = part.depth > 8 ? at[0] | at[1] << 8 : at[0];
    values[static_cast<std::size_t>(i)] = sample >> part.shift;
  }
  return values;
}

std::uint8_t toByte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Frame toRgba(const AVFrame& picture) {
  const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(static_cast<AVPixelFormat>(picture.format));
  const bool rgb = (format.flags & AV_PIX_FMT_FLAG_RGB) != 0;
  const double levels = 1 << (format.comp[0].depth - 8);
  Frame frame;
  frame.width = picture.width;
  frame.height = picture.height;
  for (int row = 0; row < frame.height; ++row) {
    for (int column = 0; column < frame.width; ++column) {
      const std::array<int, 4> c = componentsAt(picture, row, column);
      const std::uint8_t alpha =
          c[3] < 0 ? 255 : toByte(c[3] * 255.0 / ((1 << format.comp[format.nb_components - 1].depth) - 1));
      if (rgb) {
        frame.rgba.insert(frame.rgba.end(), {static_cast<std::uint8_t>(c[0]), static_cast<std::uint8_t>(c[1]),
                                             static_cast<std::uint8_t>(c[2]), alpha});
        continue;
      }
      const double y = (c[0] / levels - 16.0) / 219.0;
      const double cb = (c[1] / levels - 128.0) / 224.0;
      const double cr = (c[2] / levels - 128.0) / 224.0;
      const double red = y + 1.5748 * cr;
      const double blue = y + 1.8556 * cb;
      const double green = (y - 0.2126 * red - 0.0722 * blue) / 0.7152;
      frame.rgba.insert(frame.rgba.end(),
                        {toByte(255.0 * red), toByte(255.0 * green), toByte(255.0 * blue), alpha});
    }
  }
  return frame;
}

} // namespace

std::vector<ShownFrame> decodeFrames(const std::filesystem::path& file) {
  AVFormatContext* opened = nullptr;
  require(avformat_open_input(&opened, ("file:" + file.native()).c_str(), nullptr, nullptr) >= 0, "open");
  const std::unique_ptr<AVFormatContext, LibavFree> format(opened);
  require(avformat_find_stream_info(opened, nullptr) >= 0 && opened->nb_streams == 1, "streams");
  const AVStream& stream = *opened->streams[0];
  // FFmpeg's own VP9 decoder leaves the alpha out.
  const AVCodec* codec = stream.codecpar->codec_id == AV_CODEC_ID_VP9
                             ? avcodec_find_decoder_by_name("libvpx-vp9")
                             : avcodec_find_decoder(stream.codecpar->codec_id);
  require(codec != nullptr, "decoder");
  const std::unique_ptr<AVCodecContext, LibavFree> decoder(avcodec_alloc_context3(codec));
  require(avcodec_parameters_to_context(decoder.get(), stream.codecpar) >= 0, "parameters");
  decoder->pkt_timebase = stream.time_base;
  require(avcodec_open2(decoder.get(), codec, nullptr) >= 0, "open decoder");

  std::vector<ShownFrame> shown;
  const std::unique_ptr<AVPacket, LibavFree> packet(av_packet_alloc());
  const std::unique_ptr<AVFrame, LibavFree> picture(av_frame_alloc());
  const auto receive = [&] {
    while (avcodec_receive_frame(decoder.get(), picture.get()) >= 0) {
      require(picture->decode_error_flags == 0, "a frame is damaged");
      const double unit = av_q2d(stream.time_base);
      shown.push_back({toRgba(*picture), static_cast<double>(picture->best_effort_timestamp) * unit,
                       static_cast<double>(picture->pkt_duration) * unit});
    }
  };
  while (av_read_frame(opened, packet.get()) >= 0) {
    require(avcodec_send_packet(decoder.get(), packet.get()) >= 0, "a frame does not decode");
    av_packet_unref(packet.get());
    receive();
  }
  avcodec_send_packet(decoder.get(), nullptr);
  receive();
  return shown;
}

FrameDifference compareFrames(const Frame& a, const Frame& b) {
  FrameDifference difference;
  double sum = 0.0;
  double sumAlpha = 0.0;
  for (std::size_t i = 0; i < a.rgba.size() && i < b.rgba.size(); ++i) {
    const int levels = std::abs(a.rgba[i] - b.rgba[i]);
    if (i % 4 == 3) {
      sumAlpha += levels;
      continue;
    }
    difference.worst = std::max(difference.worst, levels);
    sum += levels;
  }
  const double pixels = static_cast<double>(a.rgba.size()) / 4.0;
  difference.mean = sum / (3.0 * pixels);
  difference.meanAlpha = sumAlpha / pixels;
  return difference;
}

} // namespace offstage::test
