#include "render/output/verify_animation.h"

#include "render/output/file_error.h"
#include "render/output/input_file.h"

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace offstage {
namespace {

[[noreturn]] void fail(const std::filesystem::path& name, std::string_view why) {
  throw Error(ExitCode::Transient, fmt::format("the check of the finished {} failed: {}", quoted(name), why));
}

bool decodes(AVCodecContext& decoder, const AVPacket& packet) {
  const libav::VideoFrame frame = libav::makeFrame();
  return avcodec_send_packet(&decoder, &packet) >= 0 && avcodec_receive_frame(&decoder, frame.get()) >= 0;
}

} // namespace

void verifyAnimation(const std::filesystem::path& file, const ExpectedAnimation& expected,
                     const std::filesystem::path& name) {
  libav::InputContext format;
  if (libav::openInput(file, format) < 0) fail(name, "it cannot be opened again");
  AVFormatContext* const opened = format.get();
  if (avformat_find_stream_info(opened, nullptr) < 0 || opened->nb_streams != 1)
    fail(name, "its stream is not recognised");
  const AVCodecParameters& stream = *opened->streams[0]->codecpar;
  if (expected.codec != std::string_view(avcodec_get_name(stream.codec_id)))
    fail(name, fmt::format("codec {} instead of {}", avcodec_get_name(stream.codec_id), expected.codec));
  if (stream.width != expected.width || stream.height != expected.height) {
    fail(name, fmt::format("size {} × {} instead of {} × {}", stream.width, stream.height, expected.width,
                           expected.height));
  }
  const AVCodec* codec = avcodec_find_decoder(stream.codec_id);
  if (codec == nullptr)
    throw Error(ExitCode::Environment, "libavcodec has no decoder to check the output with");
  const libav::CodecContext decoder(libav::allocated(avcodec_alloc_context3(codec)));
  decoder->thread_count = 1;
  if (avcodec_parameters_to_context(decoder.get(), &stream) < 0 ||
      avcodec_open2(decoder.get(), codec, nullptr) < 0)
    fail(name, "its decoder does not open");

  std::int64_t frames = 0;
  const libav::Packet packet = libav::makePacket();
  const libav::Packet last = libav::makePacket();
  while (av_read_frame(opened, packet.get()) >= 0) {
    if (frames == 0 && !decodes(*decoder, *packet)) fail(name, "its first frame does not decode");
    av_packet_unref(last.get());
    av_packet_move_ref(last.get(), packet.get());
    ++frames;
  }
  if (frames != expected.frames)
    fail(name, fmt::format("number of frames {} instead of {}", frames, expected.frames));
  if (frames > 1 && !decodes(*decoder, *last)) fail(name, "its last frame does not decode");
}

} // namespace offstage
