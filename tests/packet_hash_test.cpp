#include "render/output/packet_hash.h"

#include <cstring>
#include <string_view>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using namespace std::string_view_literals;

libav::Packet packetOf(std::string_view data) {
  libav::Packet packet = libav::makePacket();
  if (av_new_packet(packet.get(), static_cast<int>(data.size())) < 0) throw std::bad_alloc();
  std::memcpy(packet->data, data.data(), data.size());
  return packet;
}

std::uint64_t stored(std::string_view data) {
  PacketHash hash;
  hash.addStored(*packetOf(data));
  return hash.value();
}

std::uint64_t encoded(std::string_view data, VideoCodec codec) {
  PacketHash hash;
  hash.addEncoded(*packetOf(data), codec);
  return hash.value();
}

TEST(PacketHash, UnitsBehindStartCodesAreAsThoseBehindTheirLengths) {
  const std::string_view lengths = "\0\0\0\2\x67\1\0\0\0\5\x65\0\1\0\3\0\0\0\1\x41"sv;
  // Both lengths of a start code; one that is none, since only one zero stands before the 1.
  for (const VideoCodec codec : {VideoCodec::H264, VideoCodec::H264Rgb}) {
    EXPECT_EQ(encoded("\0\0\0\1\x67\1\0\0\1\x65\0\1\0\3\0\0\0\1\x41"sv, codec), stored(lengths));
    EXPECT_EQ(encoded("\0\0\1\x67\1\0\0\0\1\x65\0\1\0\3\0\0\1\x41"sv, codec), stored(lengths));
    EXPECT_NE(encoded("\0\0\1\x67\1\0\0\0\1\x65\0\1\0\4\0\0\1\x41"sv, codec), stored(lengths));
  }
  EXPECT_NE(encoded("\0\0\1\x67\1\0\0\0\1\x65\0\1\0\3\0\0\1\x41"sv, VideoCodec::Vp9), stored(lengths));
}

TEST(PacketHash, OfOtherCodecsIsThatOfTheData) {
  for (const VideoCodec codec : {VideoCodec::Vp9, VideoCodec::ProRes, VideoCodec::Ffv1})
    EXPECT_EQ(encoded("\0\0\1\x67\1\0"sv, codec), stored("\0\0\1\x67\1\0"sv));
  EXPECT_NE(stored("a"), stored("b"));
}

TEST(PacketHash, TransparencyBesideAPacketCounts) {
  const auto withBeside = [](std::string_view beside, AVPacketSideDataType type) {
    const libav::Packet packet = packetOf("a");
    std::uint8_t* const data = av_packet_new_side_data(packet.get(), type, beside.size());
    if (data == nullptr) throw std::bad_alloc();
    std::memcpy(data, beside.data(), beside.size());
    PacketHash before;
    PacketHash after;
    before.addEncoded(*packet, VideoCodec::Vp9);
    after.addStored(*packet);
    EXPECT_EQ(before.value(), after.value()) << beside;
    return after.value();
  };
  constexpr AVPacketSideDataType kBeside = AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL;
  EXPECT_NE(withBeside("alpha", kBeside), withBeside("alphb", kBeside));
  EXPECT_NE(withBeside("alpha", kBeside), stored("a"));
  // What an encoder only tells is not in the file.
  EXPECT_EQ(withBeside("alpha", AV_PKT_DATA_QUALITY_STATS), stored("a"));
}

TEST(PacketHash, PacketsWithoutAnyUnitAreNothing) {
  for (const std::string_view data : {""sv, "\1"sv, "\0\1"sv, "\0\0"sv, "abc"sv})
    EXPECT_EQ(encoded(data, VideoCodec::H264), PacketHash().value()) << data.size();
}

} // namespace
} // namespace offstage
