#include "render/output/video_output.h"

#include "render/output/chunk_file.h"
#include "render/output/codecs.h"
#include "render/output/file_error.h"
#include "render/output/frame_check.h"
#include "render/output/packet_hash.h"
#include "render/output/packet_record.h"
#include "render/output/picture_limit.h"
#include "render/output/verify.h"
#include "render/output/verify_tracks.h"
#include "render/output/yuv.h"

#include <algorithm>
#include <utility>
#include <vector>

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
/// The largest pictures that a level promises a player for: 6.2 of H.264 (139264 macroblocks, ITU-T H.264,
/// table A-1) and 6.2 of VP9 alike.
constexpr std::int64_t kMostLevelPixels = 35651584;

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
  EncoderSettings settings;
  settings.quality = format.quality.value_or(Quality::Good);
  settings.alpha = format.alpha;
  settings.codec = chooseCodec(path, container, format.alpha, settings.quality);
  settings.width = format.width;
  settings.height = format.height;
  const CodecTraits& traits = traitsOf(settings.codec);
  if (format.width < traits.leastSide || format.height < traits.leastSide)
    throw Error(ExitCode::BadInput,
                fmt::format("{}: {} holds at least {} px a side, not {} × {}; use .apng or a PNG sequence "
                            "(frames/%06d.png)",
                            quoted(path), traits.title, traits.leastSide, format.width, format.height));
  requireCodedSize(path, traits.title, traits.mostSide, format.width, format.height);
  requireEncoder(settings.codec);
  const AVRational rate = frameRateOf(format.fps);
  if (rate.num == 0) {
    settings.timeBase = variableTimeBase(container);
    settings.frameRate = kNominalRate;
  } else {
    settings.timeBase = av_inv_q(rate);
    settings.frameRate = rate;
    if (!holdsFrameRate(container, rate)) {
      throw Error(ExitCode::BadInput,
                  fmt::format("{}: {} counts in milliseconds, so {} frames a second do not fit; use .mp4",
                              quoted(path), path.extension().native(), format.fps));
    }
  }
  return settings;
}

struct Span {
  std::int64_t start = 0; ///< ticks
  std::int64_t end = 0;   ///< ticks
};

/// Ticks of a constant rate are its frames.
Span spanOf(const FrameTiming& timing, double fps, AVRational timeBase) {
  if (fps > 0.0) return {timing.index, timing.index + 1};
  return {av_rescale_q(timing.start, kNanosecond, timeBase), av_rescale_q(timing.end, kNanosecond, timeBase)};
}

class VideoChunkWriter : public ChunkWriter {
public:
  VideoChunkWriter(const std::filesystem::path& file, const SinkFormat& format,
                   const EncoderSettings& settings, std::int64_t firstFrame)
      : format_(format),
        settings_(settings),
        order_(firstFrame, format.fps == 0.0),
        file_(file),
        encoder_(settings) {}

  void write(const Frame& frame, const FrameTiming& timing) override {
    requireFrameSize(frame, format_.width, format_.height);
    order_.require(timing);
    const Span span = spanOf(timing, format_.fps, settings_.timeBase);
    if (span.start == span.end) return;
    if (span.end - span.start > kMostTicks) {
      throw Error(ExitCode::BadInput,
                  fmt::format("frame {} lasts {:.0f} s; a video's frame lasts at most {:.0f} s", timing.index,
                              static_cast<double>(timing.end - timing.start) * 1e-9,
                              static_cast<double>(kMostTicks) * av_q2d(settings_.timeBase)));
    }
    encoder_.encode(frame, span.start, span.end - span.start,
                    [this](const AVPacket& packet) { keep(packet); });
  }

  void skip(const FrameTiming& timing) override { order_.require(timing); }

  void finish() override {
    encoder_.drain([this](const AVPacket& packet) { keep(packet); });
    file_.commit();
  }

  [[nodiscard]] std::int64_t bytesWritten() const override { return file_.bytesWritten(); }

private:
  void keep(const AVPacket& packet) {
    packPacket(packet, record_);
    file_.add(record_);
  }

  const SinkFormat& format_;
  const EncoderSettings& settings_;
  FrameOrder order_;
  ChunkFileWriter file_;
  VideoEncoder encoder_;
  std::vector<std::uint8_t> record_;
};

} // namespace

VideoOutput::VideoOutput(const std::filesystem::path& path, Container container, const SinkFormat& format)
    : path_(path), container_(container), format_(format), settings_(settingsOf(path, container, format)) {
  requireWritable(path_);
}

std::string VideoOutput::description() const {
  // Chunks by different versions of an encoder must not be joined.
  return fmt::format("{} {}x{} px, time base {}/{}, quality {}{}, {}", traitsOf(settings_.codec).encoder,
                     settings_.width, settings_.height, settings_.timeBase.num, settings_.timeBase.den,
                     qualityName(settings_.quality), settings_.alpha ? ", transparent" : "", libavVersions());
}

std::string VideoOutput::notice() const {
  std::string text;
  if (!traitsOf(settings_.codec).subsampled) return text;
  const auto add = [&text](const char* side, int size, const char* line) {
    if (size == evenSize(size)) return;
    if (!text.empty()) text += '\n';
    text +=
        fmt::format("{} {} is odd: padded to {} by repeating the last {}", side, size, evenSize(size), line);
  };
  add("width", format_.width, "column");
  add("height", format_.height, "row");
  if (static_cast<std::int64_t>(format_.width) * format_.height > kMostLevelPixels) {
    if (!text.empty()) text += '\n';
    text += fmt::format("{} × {} px are more than the largest level of {} has: many players will not show it",
                        format_.width, format_.height, traitsOf(settings_.codec).title);
  }
  return text;
}

bool VideoOutput::holds(const FrameTiming& timing) const {
  const Span span = spanOf(timing, format_.fps, settings_.timeBase);
  return span.start < span.end;
}

std::unique_ptr<ChunkWriter> VideoOutput::begin(const std::filesystem::path& file,
                                                std::int64_t firstFrame) const {
  return std::make_unique<VideoChunkWriter>(file, format_, settings_, firstFrame);
}

bool VideoOutput::isWhole(const std::filesystem::path& file) const {
  return isWholeChunk(file);
}

std::int64_t VideoOutput::join(std::span<const std::filesystem::path> chunks, std::int64_t frames) {
  AtomicFile file(path_);
  MuxerSettings muxerSettings;
  muxerSettings.container = container_;
  muxerSettings.timeBase = settings_.timeBase;
  if (format_.fps > 0.0) muxerSettings.frameRate = settings_.frameRate;
  muxerSettings.title = format_.title;
  muxerSettings.tracks = tracks();
  Muxer muxer(file, muxerSettings, VideoEncoder(settings_).parameters());

  ExpectedVideo expected;
  expected.codec = settings_.codec;
  const bool padded = traitsOf(settings_.codec).subsampled;
  expected.width = padded ? evenSize(format_.width) : format_.width;
  expected.height = padded ? evenSize(format_.height) : format_.height;
  expected.timeBase = settings_.timeBase;
  std::int64_t packets = 0;
  PacketHash hash;
  const libav::Packet packet = libav::makePacket();
  std::vector<std::uint8_t> record;
  for (const std::filesystem::path& chunk : chunks) {
    ChunkFileReader reader(chunk);
    while (reader.next(record)) {
      unpackPacket(record, *packet);
      hash.addEncoded(*packet, settings_.codec);
      expected.lastStart = std::max(expected.lastStart, packet->pts);
      expected.end = std::max(expected.end, packet->pts + packet->duration);
      muxer.write(*packet);
      tellJoined(++packets);
    }
  }
  if (packets == 0) throw Error(ExitCode::BadInput, fmt::format("no frames to write to {}", quoted(path_)));
  muxer.finish();
  // Of a variable rate, frames that are never seen have no packet.
  expected.frames = format_.fps > 0.0 ? frames : packets;
  expected.packets = hash.value();
  expected.hasSound = tracks().sound != nullptr;
  verifyVideo(file.temporary(), expected, path_);
  verifyTracks(file.temporary(), container_, tracks(), path_);
  file.commit();
  return muxer.bytesWritten();
}

} // namespace offstage
