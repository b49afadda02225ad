#include "render/output/packet_record.h"

#include "render/output/byte_order.h"

#include <cstring>

#include <climits>

namespace offstage {
namespace {

template <class T>
void append(std::vector<std::uint8_t>& bytes, T value) {
  const auto number = littleEndian(value);
  bytes.insert(bytes.end(), number.begin(), number.end());
}

void append(std::vector<std::uint8_t>& bytes, const std::uint8_t* data, std::size_t size) {
  append(bytes, static_cast<std::uint64_t>(size));
  bytes.insert(bytes.end(), data, data + size);
}

class Reader {
public:
  explicit Reader(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  template <class T>
  T number() {
    return fromLittleEndian<T>(take(sizeof(T)));
  }
  std::span<const std::uint8_t> block() { return take(number<std::uint64_t>()); }
  [[nodiscard]] bool atEnd() const { return left_.empty(); }

private:
  std::span<const std::uint8_t> take(std::uint64_t size) {
    if (size > left_.size() || size > INT_MAX)
      throw Error(ExitCode::Transient, "a chunk holds a damaged packet");
    const auto part = left_.first(size);
    left_ = left_.subspan(size);
    return part;
  }
  std::span<const std::uint8_t> left_;
};

} // namespace

void packPacket(const AVPacket& packet, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  append(bytes, packet.pts);
  append(bytes, packet.duration);
  append(bytes, static_cast<std::int32_t>(packet.flags));
  append(bytes, packet.data, static_cast<std::size_t>(packet.size));
  for (int i = 0; i < packet.side_data_elems; ++i) {
    const AVPacketSideData& side = packet.side_data[i];
    // Statistics of an encoder's pass are no part of the file.
    if (side.type == AV_PKT_DATA_QUALITY_STATS || side.type == AV_PKT_DATA_CPB_PROPERTIES) continue;
    append(bytes, static_cast<std::int32_t>(side.type));
    append(bytes, side.data, side.size);
  }
}

void unpackPacket(std::span<const std::uint8_t> bytes, AVPacket& packet) {
  av_packet_unref(&packet);
  Reader reader(bytes);
  const auto pts = reader.number<std::int64_t>();
  const auto duration = reader.number<std::int64_t>();
  const auto flags = reader.number<std::int32_t>();
  const auto data = reader.block();
  libav::check(av_new_packet(&packet, static_cast<int>(data.size())), ExitCode::Transient,
               "no memory for a packet");
  if (!data.empty()) std::memcpy(packet.data, data.data(), data.size());
  packet.pts = pts;
  packet.duration = duration;
  packet.flags = flags;
  while (!reader.atEnd()) {
    const auto type = static_cast<AVPacketSideDataType>(reader.number<std::int32_t>());
    const auto side = reader.block();
    std::uint8_t* copy = libav::allocated(av_packet_new_side_data(&packet, type, side.size()));
    if (!side.empty()) std::memcpy(copy, side.data(), side.size());
  }
}

} // namespace offstage
