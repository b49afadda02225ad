#include "render/output/chunk_file.h"
#include "render/output/packet_record.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorOf;
using test::TempDir;
using testing::HasSubstr;
using testing::IsEmpty;

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> someRecords() {
  Bytes large(100000);
  std::iota(large.begin(), large.end(), std::uint8_t{0});
  return {{}, {1}, {0, 255, 0}, large};
}

std::filesystem::path writeChunk(const TempDir& dir) {
  ChunkFileWriter writer(dir / "a.chunk");
  for (const Bytes& record : someRecords()) writer.add(record);
  writer.commit();
  EXPECT_EQ(writer.bytesWritten(), static_cast<std::int64_t>(std::filesystem::file_size(dir / "a.chunk")));
  return dir / "a.chunk";
}

std::string readAll(const std::filesystem::path& file) {
  return errorOf([&] {
    ChunkFileReader reader(file);
    Bytes record;
    while (reader.next(record)) {
    }
  });
}

TEST(ChunkFile, GivesItsRecordsBack) {
  const TempDir dir;
  ChunkFileReader reader(writeChunk(dir));
  Bytes record;
  for (const Bytes& expected : someRecords()) {
    ASSERT_TRUE(reader.next(record));
    EXPECT_EQ(record, expected);
  }
  EXPECT_FALSE(reader.next(record));
}

TEST(ChunkFile, EveryCutIsFoundAndEveryFlippedBit) {
  const TempDir dir;
  const std::filesystem::path file = writeChunk(dir);
  const std::string whole = test::readFile(file);
  EXPECT_TRUE(isWholeChunk(file));
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
    test::writeFile(file, whole.substr(0, size));
    EXPECT_FALSE(isWholeChunk(file)) << "cut to " << size;
  }
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 89) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    test::writeFile(file, damaged);
    EXPECT_FALSE(isWholeChunk(file)) << "bit flipped at " << at;
  }
  test::writeFile(file, whole + "x");
  EXPECT_THAT(readAll(file), HasSubstr("75: "));
  EXPECT_THAT(readAll(file), HasSubstr("goes on after its end"));
}

TEST(ChunkFile, NothingAndOtherThingsAreNoChunks) {
  const TempDir dir;
  EXPECT_FALSE(isWholeChunk(dir / "none"));
  EXPECT_FALSE(isWholeChunk(dir.path()));
  test::writeFile(dir / "text", "not a chunk at all, but long enough to be one");
  EXPECT_THAT(readAll(dir / "text"), HasSubstr("does not begin as one"));
}

TEST(ChunkFile, AnImpossibleSizeTakesNoMemory) {
  const TempDir dir;
  std::string bytes = test::readFile(writeChunk(dir)).substr(0, 17);
  bytes.append("\xFE\xFF\xFF\xFF\xFF\xFF\xFF\x7F", 8).append(100, 'x');
  test::writeFile(dir / "a.chunk", bytes);
  EXPECT_THAT(readAll(dir / "a.chunk"), HasSubstr("ends too early"));
}

TEST(ChunkFile, UnfinishedLeavesNothing) {
  const TempDir dir;
  { ChunkFileWriter(dir / "a.chunk").add(Bytes{1, 2, 3}); }
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(PacketRecord, KeepsAllThatAMuxerNeeds) {
  const libav::Packet packet = libav::makePacket();
  ASSERT_EQ(av_new_packet(packet.get(), 5), 0);
  std::ranges::copy(std::string_view("hello"), packet->data);
  packet->pts = -3;
  packet->duration = 1LL << 40U;
  packet->flags = AV_PKT_FLAG_KEY;
  std::uint8_t* side = av_packet_new_side_data(packet.get(), AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, 3);
  std::ranges::copy(std::string_view("abc"), side);
  Bytes bytes;
  packPacket(*packet, bytes);

  const libav::Packet back = libav::makePacket();
  unpackPacket(bytes, *back);
  EXPECT_EQ(std::string(back->data, back->data + back->size), "hello");
  EXPECT_EQ(back->pts, -3);
  EXPECT_EQ(back->duration, 1LL << 40U);
  EXPECT_EQ(back->flags, AV_PKT_FLAG_KEY);
  ASSERT_EQ(back->side_data_elems, 1);
  EXPECT_EQ(back->side_data[0].type, AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL);
  EXPECT_EQ(std::string(back->side_data[0].data, back->side_data[0].data + 3), "abc");

  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // Cut where the side data begin, what is left is a packet without them.
    if (size == bytes.size() - 3 - 8 - 4) continue;
    EXPECT_THAT(errorOf([&] { unpackPacket(std::span(bytes).first(size), *back); }),
                HasSubstr("75: a chunk holds"))
        << size;
  }
}

} // namespace
} // namespace offstage
