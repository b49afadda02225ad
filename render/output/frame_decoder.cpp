#include "render/output/frame_decoder.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace offstage {

FrameDecoder::FrameDecoder(const AVStream& stream, Fail fail)
    : fail_(std::move(fail)), frame_(libav::makeFrame()) {
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr) {
    throw Error(ExitCode::Environment, "libavcodec has no decoder to check the finished video with: "
                                       "install the Debian package libavcodec59");
  }
  context_.reset(libav::allocated(avcodec_alloc_context3(codec)));
  check(avcodec_parameters_to_context(context_.get(), stream.codecpar), "its codec is not described");
  context_->pkt_timebase = stream.time_base;
  context_->thread_count = 1;
  context_->skip_loop_filter = AVDISCARD_ALL;
  check(avcodec_open2(context_.get(), codec, nullptr), "its decoder does not open");
}

bool FrameDecoder::decode(const AVPacket* packet) {
  check(avcodec_send_packet(context_.get(), packet), "a frame does not decode");
  bool any = false;
  while (true) {
    const int result = avcodec_receive_frame(context_.get(), frame_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return any;
    check(result, "a frame does not decode");
    if (frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0)
      fail_("a frame is damaged");
    any = true;
    if (first_ == AV_NOPTS_VALUE || frame_->pts < first_) first_ = frame_->pts;
    last_ = std::max(last_, frame_->pts);
  }
}

int FrameDecoder::check(int result, std::string_view what) const {
  if (result == AVERROR(ENOMEM)) throw std::bad_alloc();
  if (result < 0) fail_(fmt::format("{}: {}", what, libav::errorText(result)));
  return result;
}

} // namespace offstage
