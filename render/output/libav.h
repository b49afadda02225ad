#pragma once

#include "src/sim/error.h"

#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <string_view>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

/// FFmpeg's libraries with owners and errors of C++.
namespace offstage::libav {

struct Free {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVCodecParameters* parameters) const { avcodec_parameters_free(&parameters); }
  /// Of a context made with avformat_alloc_output_context2.
  void operator()(AVFormatContext* context) const { avformat_free_context(context); }
  /// Of a context made with avio_alloc_context: its buffer is not freed with it.
  void operator()(AVIOContext* context) const {
    av_freep(&context->buffer);
    avio_context_free(&context);
  }
};
using Packet = std::unique_ptr<AVPacket, Free>;
using VideoFrame = std::unique_ptr<AVFrame, Free>;
using CodecContext = std::unique_ptr<AVCodecContext, Free>;
using CodecParameters = std::unique_ptr<AVCodecParameters, Free>;
using OutputContext = std::unique_ptr<AVFormatContext, Free>;
using IoContext = std::unique_ptr<AVIOContext, Free>;

/// `pointer` if it is not null; else std::bad_alloc, the only reason for which libav's allocators return
/// null.
template <class T>
T* allocated(T* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

inline Packet makePacket() {
  return Packet(allocated(av_packet_alloc()));
}
inline VideoFrame makeFrame() {
  return VideoFrame(allocated(av_frame_alloc()));
}

/// An output of `bufferSize` gathered bytes that calls `write` and `seek` with `self`, as avio_alloc_context
/// has them.
IoContext makeOutput(int bufferSize, void* self, int (*write)(void*, std::uint8_t*, int),
                     std::int64_t (*seek)(void*, std::int64_t, int));

/// The options of one call, and afterwards those that the call did not take.
class Options {
public:
  Options() = default;
  ~Options() { av_dict_free(&entries_); }
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  void set(const char* key, const std::string& value);
  AVDictionary** get() { return &entries_; }
  /// Throws std::logic_error when libav has not taken an option: its name is wrong, or this version lacks it.
  void requireAllTaken() const;

private:
  AVDictionary* entries_ = nullptr;
};

/// What libav says of an error number.
std::string errorText(int error);

/// `result` if it is not an error; else throws Error(code, "WHAT: what libav says").
int check(int result, ExitCode code, std::string_view what);

/// Makes libav log no more than `level` on stderr, unless the program has already chosen to hear less. Called
/// by everything here that opens something: what encodes lets errors through, what reads does not, whose
/// callers say themselves what is wrong with a file.
void quietLog(int level = AV_LOG_ERROR);

} // namespace offstage::libav
