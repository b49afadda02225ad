#include "render/output/video_sink.h"

#include "render/output/file_error.h"
#include "render/output/frame_check.h"
#include "render/output/verify.h"
#include "render/output/yuv.h"

#include <utility>

#include <fmt/format.h>

namespace offstage {

namespace {

constexpr AVRational kNanosecond{1, 1000000000};
/// Of frames of variable length: the display rate that most main loops are driven by.
constexpr AVRational kNominalRate{60, 1};
/// Numerator and denominator of a frame rate, at most: 30000/1001 and its kin are exact, and so are rates
/// with up to five decimals below 10.
constexpr int kMostRateTerm = 1001000;
constexpr double kLeastFps = 0.001;
constexpr double kMostFps = 1000000.0;
/// The longest that .mp4 can show a frame is 2^31 − 1 ticks, 2147 s at a microsecond.
constexpr std::int64_t kMostTicks = 2147483647;
/// x264's limit.
constexpr int kMostSide = 16384;

/// A constant rate as a fraction; 0/1 when the rate is variable.
AVRational frameRateOf(double fps) {
  if (fps == 0.0) return {0, 1};
  if (!(fps >= kLeastFps && fps <= kMostFps)) { // NaN too
    throw Error(ExitCode::BadInput,
                fmt::format("a video has {} to {} frames a second, not {}", kLeastFps, kMostFps, fps));
  }
  return av_d2q(fps, kMostRateTerm);
}

EncoderSettings settingsOf(const std::filesystem::path& path, Container container, const SinkFormat& format) {
  if (format.alpha) {
    throw Error(
        ExitCode::BadInput,
        fmt::format(
            "{}: H.264 video has no transparency; use a PNG sequence (frames/%06d.png) or .raw, or an opaque "
            "background",
            quoted(path)));
  }
  if (format.width > kMostSide || format.height > kMostSide) {
    throw Error(ExitCode::BadInput,
                fmt::format("{}: H.264 holds pictures of at most {} px a side, not {} × {}", quoted(path),
                            kMostSide, format.width, format.height));
  }
  const AVRational rate = frameRateOf(format.fps);
  EncoderSettings settings;
  settings.width = format.width;
  settings.height = format.height;
  settings.keyInterval = kChunkFrames;
  if (rate.num == 0) {
    settings.timeBase = variableTimeBase(container);
    settings.frameRate = kNominalRate;
  } else {
    settings.timeBase = av_inv_q(rate);
    settings.frameRate = rate;
    if (!holdsFrameRate(container, rate)) {
      throw Error(ExitCode::BadInput,
                  fmt::format("{}: .mkv counts in milliseconds, so {} frames a second do not fit; use .mp4",
                              quoted(path), format.fps));
    }
  }
  return settings;
}

} // namespace

VideoSink::VideoSink(const std::filesystem::path& path, Container container, const SinkFormat& format)
    : format_(format),
      settings_(settingsOf(path, container, format)),
      file_(path),
      encoder_(std::make_unique<VideoEncoder>(settings_)) {
  MuxerSettings muxer;
  muxer.container = container;
  muxer.timeBase = settings_.timeBase;
  if (format.fps > 0.0) muxer.frameRate = settings_.frameRate;
  muxer.title = format.title;
  muxer_ = std::make_unique<Muxer>(file_, muxer, encoder_->parameters());
}

VideoSink::Span VideoSink::spanOf(const FrameTiming& timing) const {
  if (format_.fps > 0.0) return {timing.index, timing.index + 1};
  return {av_rescale_q(timing.start - origin_, kNanosecond, settings_.timeBase),
          av_rescale_q(timing.end - origin_, kNanosecond, settings_.timeBase)};
}

void VideoSink::requireInOrder(const FrameTiming& timing) const {
  if (timing.index != nextIndex_) {
    throw Error(ExitCode::BadInput,
                fmt::format("frame {} came where frame {} was due", timing.index, nextIndex_));
  }
  if (format_.fps > 0.0) return;
  if (timing.end < timing.start || timing.start < 0 || (nextIndex_ > 0 && timing.start != nextStart_)) {
    throw Error(ExitCode::BadInput,
                fmt::format("frame {} is shown from {} to {} ns, which does not follow the frame before it",
                            timing.index, timing.start, timing.end));
  }
}

void VideoSink::write(const Frame& frame, const FrameTiming& timing) {
  requireFrameSize(frame, format_.width, format_.height);
  requireInOrder(timing);
  if (nextIndex_ == 0) origin_ = timing.start;
  nextIndex_ = timing.index + 1;
  nextStart_ = timing.end;

  const Span span = spanOf(timing);
  if (span.start == span.end) return;
  if (span.end - span.start > kMostTicks) {
    throw Error(ExitCode::BadInput,
                fmt::format("frame {} lasts {:.0f} s; a video's frame lasts at most {:.0f} s", timing.index,
                            static_cast<double>(timing.end - timing.start) * 1e-9,
                            static_cast<double>(kMostTicks) * av_q2d(settings_.timeBase)));
  }
  last_ = span;
  const auto take = [this](AVPacket& packet) { muxer_->write(packet); };
  if (const std::int64_t chunk = timing.index / kChunkFrames; chunk != chunk_) {
    drainEncoder();
    encoder_ = std::make_unique<VideoEncoder>(settings_);
    chunk_ = chunk;
  }
  encoder_->encode(frame, span.start, span.end - span.start, take);
  ++frames_;
}

void VideoSink::drainEncoder() {
  encoder_->drain([this](AVPacket& packet) { muxer_->write(packet); });
  encoder_.reset();
}

void VideoSink::finish() {
  if (frames_ == 0)
    throw Error(ExitCode::BadInput, fmt::format("no frames to write to {}", quoted(file_.path())));
  drainEncoder();
  muxer_->finish();
  ExpectedVideo expected;
  expected.width = evenSize(format_.width);
  expected.height = evenSize(format_.height);
  expected.frames = frames_;
  expected.timeBase = settings_.timeBase;
  expected.lastStart = last_.start;
  expected.end = last_.end;
  verifyVideo(file_.temporary(), expected, file_.path());
  file_.commit();
}

std::string VideoSink::notice() const {
  std::string text;
  const auto add = [&text](const char* side, int size, const char* line) {
    if (size == evenSize(size)) return;
    if (!text.empty()) text += '\n';
    text +=
        fmt::format("{} {} is odd: padded to {} by repeating the last {}", side, size, evenSize(size), line);
  };
  add("width", format_.width, "column");
  add("height", format_.height, "row");
  return text;
}

std::int64_t VideoSink::bytesWritten() const {
  return muxer_->bytesWritten();
}

} // namespace offstage
