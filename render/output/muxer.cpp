#include "render/output/muxer.h"

#include "render/output/file_error.h"
#include "render/output/side_streams.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace offstage {

namespace {

/// Bytes gathered before they go to the file.
constexpr int kBufferSize = 1 << 16;
/// libavformat's .mkv and .webm count in milliseconds.
constexpr AVRational kMatroskaTick{1, 1000};
constexpr AVRational kMicrosecond{1, 1000000};
constexpr AVRational kNanosecond{1, 1000000000};
/// The coarsest timescale that libavformat chooses for .mp4 by itself; finer ones serve players that compute
/// in it.
constexpr int kLeastTimescale = 10000;

const char* formatName(Container container) {
  switch (container) {
  case Container::Mp4:
    return "mp4";
  case Container::Mov:
    return "mov";
  case Container::Matroska:
    return "matroska";
  case Container::WebM:
    return "webm";
  }
  throw std::logic_error("unknown container");
}

bool isMatroska(Container container) {
  return container == Container::Matroska || container == Container::WebM;
}

/// Ticks a second in which every multiple of the time base is a whole number.
int timescaleOf(AVRational timeBase) {
  int scale = timeBase.den;
  while (scale < kLeastTimescale) scale *= 2;
  return scale;
}

} // namespace

AVRational variableTimeBase(Container container) {
  return isMatroska(container) ? kMatroskaTick : kMicrosecond;
}

bool holdsFrameRate(Container container, AVRational framesPerSecond) {
  return !isMatroska(container) || av_cmp_q(framesPerSecond, av_inv_q(kMatroskaTick)) <= 0;
}

Muxer::Muxer(AtomicFile& file, const MuxerSettings& settings, const AVCodecParameters& stream)
    : file_(file),
      timeBase_(settings.timeBase),
      pending_(libav::makePacket()),
      reorderDepth_(stream.video_delay) {
  libav::quietLog();
  // libavformat reads the file by its name when it moves the index to the front; "file:" keeps a name such as
  // a:b.mp4 from being taken for a protocol.
  const std::string url = "file:" + file.temporary().native();
  AVFormatContext* format = nullptr;
  libav::check(avformat_alloc_output_context2(&format, nullptr, formatName(settings.container), url.c_str()),
               ExitCode::Environment, "libavformat cannot write this kind of file");
  format_.reset(format);
  io_ = libav::makeOutput(kBufferSize, this, writeBytes, seek);
  format_->pb = io_.get();
  format_->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;

  stream_ = libav::allocated(avformat_new_stream(format_.get(), nullptr));
  libav::check(avcodec_parameters_copy(stream_->codecpar, &stream), ExitCode::Transient,
               "cannot describe the video stream");
  // The container's own; but ProRes names its variant there, and the encoder knows which.
  if (stream.codec_id != AV_CODEC_ID_PRORES) stream_->codecpar->codec_tag = 0;
  stream_->time_base = settings.timeBase;
  stream_->avg_frame_rate = settings.frameRate;
  stream_->sample_aspect_ratio = stream.sample_aspect_ratio;
  sides_ = std::make_unique<SideStreams>(settings.container, settings.tracks, stream.width, stream.height);
  sides_->addTo(*format_);
  if (!settings.title.empty()) av_dict_set(&format_->metadata, "title", settings.title.c_str(), 0);

  libav::Options options;
  if (isMatroska(settings.container)) {
    // Opus begins with a run-up before time 0, which the container has a field for; without this libavformat
    // moves the pictures behind it.
    format_->avoid_negative_ts = 0;
    options.set("cues_to_front", "1");
  } else {
    const std::string scale = std::to_string(timescaleOf(settings.timeBase));
    options.set("movflags", "+faststart");
    // With the same scale for the movie and its track the durations of both are exact.
    options.set("video_track_timescale", scale);
    options.set("movie_timescale", scale);
  }
  require(avformat_write_header(format_.get(), options.get()), "cannot write the video's header");
  options.requireAllTaken();
}

Muxer::~Muxer() = default;

int Muxer::writeBytes(void* self, std::uint8_t* data, int size) {
  auto* muxer = static_cast<Muxer*>(self);
  try {
    muxer->file_.write(data, static_cast<std::size_t>(size));
    muxer->bytes_ = std::max(muxer->bytes_, muxer->file_.seek(0, SEEK_CUR));
    return size;
  } catch (...) { // no exception may pass through libavformat, which is C
    if (!muxer->fileError_) muxer->fileError_ = std::current_exception();
    return AVERROR(EIO);
  }
}

std::int64_t Muxer::seek(void* self, std::int64_t offset, int whence) {
  auto* muxer = static_cast<Muxer*>(self);
  try {
    if ((whence & AVSEEK_SIZE) != 0) return muxer->bytes_;
    return muxer->file_.seek(offset, whence & ~AVSEEK_FORCE);
  } catch (...) {
    if (!muxer->fileError_) muxer->fileError_ = std::current_exception();
    return AVERROR(EIO);
  }
}

void Muxer::require(int result, const char* what) {
  if (fileError_) std::rethrow_exception(std::exchange(fileError_, nullptr));
  libav::check(result, ExitCode::Transient, fmt::format("cannot write {}: {}", quoted(file_.path()), what));
}

void Muxer::write(const AVPacket& packet) {
  if (packets_ > 0) {
    lastDts_ = pending_->dts;
    writePending();
  }
  libav::check(av_packet_ref(pending_.get(), &packet), ExitCode::Transient, "no memory for a packet");
  if (packets_ == 0) firstStart_ = packet.pts;
  end_ = std::max(end_, packet.pts + packet.duration);
  starts_.push(packet.pts);
  if (packets_ < reorderDepth_) {
    pending_->dts = firstStart_ - (reorderDepth_ - packets_);
  } else {
    pending_->dts = starts_.top();
    starts_.pop();
  }
  ++packets_;
}

void Muxer::writePending() {
  AVPacket& packet = *pending_;
  packet.stream_index = stream_->index;
  // Rounded so that a frame ends where the next begins, in a container whose tick is coarser than the time
  // base too.
  const std::int64_t end = av_rescale_q(packet.pts + packet.duration, timeBase_, stream_->time_base);
  const std::int64_t time = av_rescale_q(packet.dts, timeBase_, kNanosecond);
  packet.pts = av_rescale_q(packet.pts, timeBase_, stream_->time_base);
  packet.dts = av_rescale_q(packet.dts, timeBase_, stream_->time_base);
  packet.duration = end - packet.pts;
  require(sides_->writeUntil(*format_, time), "libavformat refuses a packet of a track");
  const int result = av_write_frame(format_.get(), &packet);
  av_packet_unref(&packet);
  require(result, "libavformat refuses a packet");
}

void Muxer::endPending() {
  AVPacket& packet = *pending_;
  packet.dts =
      std::max(packet.pts - reorderDepth_, packets_ > 1 ? lastDts_ + 1 : firstStart_ - reorderDepth_);
  packet.duration = std::max<std::int64_t>(end_ - reorderDepth_ - packet.dts, 1);
}

void Muxer::finish() {
  if (packets_ > 0) {
    endPending();
    writePending();
  }
  require(sides_->writeRest(*format_), "libavformat refuses a packet of a track");
  require(av_write_trailer(format_.get()), "cannot write the video's index");
  avio_flush(io_.get());
  require(io_->error, "cannot write the video's end");
}

} // namespace offstage
