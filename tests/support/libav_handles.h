#pragma once

#include <array>
#include <stdexcept>

#include <fmt/format.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace offstage::test {

/// The deleter of libav's structures in tests, which read files back without the program's own code.
struct LibavFree {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};

/// The result of a libav call. Throws std::runtime_error with libav's reason when it is an error.
inline int requireLibav(int result, const char* what) {
  if (result >= 0) return result;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(result, text.data(), text.size());
  throw std::runtime_error(fmt::format("{}: {}", what, text.data()));
}

} // namespace offstage::test
