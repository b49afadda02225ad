#pragma once

#include "render/output/atomic_file.h"
#include "render/output/libav.h"
#include "render/output/tracks.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <queue>
#include <string>
#include <vector>

namespace offstage {

class SideStreams;

enum class Container { Mp4, Mov, Matroska, WebM };

/// The finest unit in which a container's timestamps are written, in s: 1/1000 for .mkv and .webm. .mp4 and
/// .mov take any; frames of variable length get 1/1000000 there.
AVRational variableTimeBase(Container container);

/// Whether frames of this constant rate keep distinct timestamps in the container.
bool holdsFrameRate(Container container, AVRational framesPerSecond);

/// Describes a file.
struct MuxerSettings {
  Container container = Container::Mp4;
  AVRational timeBase{0, 1};  ///< s: of the packets' timestamps
  AVRational frameRate{0, 1}; ///< 1/s; 0/1 when it is variable
  std::string title;          ///< metadata; may be empty
  VideoTracks tracks{};       ///< what stands beside the pictures
};

/// Writes packets of a video stream, and the tracks beside it, into a file. The bytes depend only on the
/// arguments and libavformat's version: no date, no random identifier. The index stands before the pictures
/// (moov before mdat, cues at the front), so a player can start before it has the whole file.
class Muxer {
public:
  /// Writes the header. The file must be empty. Throws Error as AtomicFile::write, and Error(Environment)
  /// when libavformat lacks the container.
  Muxer(AtomicFile& file, const MuxerSettings& settings, const AVCodecParameters& stream);
  ~Muxer();
  Muxer(const Muxer&) = delete;
  Muxer& operator=(const Muxer&) = delete;

  /// Takes packets in decoding order with pts and duration; pts of different chunks follow each other.
  /// Derives dts for the whole file, across chunks of separate encoders: the k-th packet's is the (k − d)-th
  /// smallest pts, d being the depth of reordering, and the first d packets' lie d … 1 ticks before the first
  /// pts. So dts rise strictly and are never after pts.
  void write(const AVPacket& packet);
  /// Writes the index; nothing may be written afterwards.
  void finish();

  [[nodiscard]] std::int64_t bytesWritten() const { return bytes_; }

private:
  static int writeBytes(void* self, std::uint8_t* data, int size);
  static std::int64_t seek(void* self, std::int64_t offset, int whence);
  /// The error that AtomicFile threw inside a callback comes out here; else check() of libav's result.
  void require(int result, const char* what);

  void writePending();
  /// .mp4 states a track's length twice: as the end of the last frame, and as the sum of what decoding times
  /// leave each packet. With equal frames both agree by themselves. With others they do if the last packet in
  /// decoding order, which need not be the last frame, is decoded d ticks before its time and lasts until the
  /// end: the sum is then end − d − (−d).
  void endPending();

  AtomicFile& file_;
  libav::IoContext io_; ///< outlives format_, which writes to it
  libav::OutputContext format_;
  std::unique_ptr<SideStreams> sides_;
  AVStream* stream_ = nullptr;
  AVRational timeBase_;
  libav::Packet pending_; ///< the packet that came last: how long it lasts depends on whether another follows
  std::exception_ptr fileError_;
  std::int64_t bytes_ = 0;
  std::int64_t packets_ = 0;
  std::int64_t reorderDepth_ = 0;
  std::int64_t firstStart_ = 0;
  std::int64_t lastDts_ = 0; ///< of the packet before pending_
  std::int64_t end_ = 0;     ///< of the frame that is shown last, so far
  /// pts that are not yet used as a dts, smallest first.
  std::priority_queue<std::int64_t, std::vector<std::int64_t>, std::greater<>> starts_;
};

} // namespace offstage
