#pragma once

#include "render/output/libav.h"
#include "render/output/stream_hash.h"
#include "render/output/video_codec.h"

#include <cstdint>
#include <span>

namespace offstage {

/// A hash of a video's packets, in decoding order, that is the same before they are written to a file and
/// when they are read from it: XXH3-64 of the data, of H.264 as containers store it, every unit behind its
/// length (ISO/IEC 14496-15, 5.3), and of what .webm keeps beside them, the transparency.
class PacketHash {
public:
  /// A packet as a container has it.
  void addStored(const AVPacket& packet);
  /// A packet as an encoder of `codec` has made it: of H.264 the units stand behind start codes (ITU-T H.264,
  /// Annex B).
  void addEncoded(const AVPacket& packet, VideoCodec codec);

  [[nodiscard]] std::uint64_t value() const { return hash_.value(); }

private:
  void addBeside(const AVPacket& packet);
  void addUnit(std::span<const std::uint8_t> unit);

  StreamHash hash_;
};

} // namespace offstage
