#include "render/output/packet_hash.h"

#include "render/output/byte_order.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace offstage {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// A unit cannot contain one, nor end with a zero.
constexpr std::size_t kStartCode = 3; // 0, 0, 1

Bytes dataOf(const AVPacket& packet) {
  return {packet.data, static_cast<std::size_t>(packet.size)};
}

/// Where the first start code at `from` or behind stands; the size of the bytes when there is none.
std::size_t findStartCode(Bytes bytes, std::size_t from) {
  for (std::size_t at = from + kStartCode - 1; at < bytes.size(); ++at) {
    const void* const one = std::memchr(&bytes[at], 1, bytes.size() - at);
    if (one == nullptr) break;
    at = static_cast<std::size_t>(static_cast<const std::uint8_t*>(one) - bytes.data());
    if (bytes[at - 1] == 0 && bytes[at - 2] == 0) return at - 2;
  }
  return bytes.size();
}

} // namespace

void PacketHash::addStored(const AVPacket& packet) {
  hash_.add(packet.data, static_cast<std::size_t>(packet.size));
  addBeside(packet);
}

void PacketHash::addEncoded(const AVPacket& packet, VideoCodec codec) {
  if (codec != VideoCodec::H264 && codec != VideoCodec::H264Rgb) {
    addStored(packet);
    return;
  }
  const Bytes bytes = dataOf(packet);
  for (std::size_t code = findStartCode(bytes, 0); code < bytes.size();) {
    const std::size_t begin = code + kStartCode;
    code = findStartCode(bytes, begin);
    std::size_t end = code;
    while (end > begin && bytes[end - 1] == 0) --end; // of a longer start code
    addUnit(bytes.subspan(begin, end - begin));
  }
}

void PacketHash::addBeside(const AVPacket& packet) {
  for (int i = 0; i < packet.side_data_elems; ++i) {
    const AVPacketSideData& side = packet.side_data[i];
    if (side.type == AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL) hash_.add(side.data, side.size);
  }
}

void PacketHash::addUnit(Bytes unit) {
  std::array<std::uint8_t, 4> length{};
  storeBigEndian(length.data(), static_cast<std::uint32_t>(unit.size()));
  hash_.add(length.data(), length.size());
  hash_.add(unit.data(), unit.size());
}

} // namespace offstage
