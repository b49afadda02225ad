#pragma once

#include "render/output/libav.h"

#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// A packet as bytes for a chunk's file: pts, duration, flags, data and side data (VP9 keeps transparency
/// there).
void packPacket(const AVPacket& packet, std::vector<std::uint8_t>& bytes);

/// The way back; dts is not set. Throws Error(Transient) when the bytes are no packet.
void unpackPacket(std::span<const std::uint8_t> bytes, AVPacket& packet);

} // namespace offstage
