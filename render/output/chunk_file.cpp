#include "render/output/chunk_file.h"

#include "render/output/byte_order.h"
#include "render/output/file_error.h"
#include "src/sim/error.h"

#include <array>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::string_view kMagic = "offstage chunk 1\n";
/// Stands where a record's size would, before the number of records and the checksum.
constexpr std::uint64_t kEnd = ~std::uint64_t{0};
constexpr std::uint64_t kTail = 3 * sizeof(std::uint64_t);

std::span<const std::uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

} // namespace

ChunkFileWriter::ChunkFileWriter(const std::filesystem::path& path) : file_(path) {
  put(bytesOf(kMagic));
}

void ChunkFileWriter::put(std::span<const std::uint8_t> bytes) {
  file_.write(bytes.data(), bytes.size());
  hash_.add(bytes.data(), bytes.size());
  bytes_ += static_cast<std::int64_t>(bytes.size());
}

void ChunkFileWriter::add(std::span<const std::uint8_t> record) {
  put(littleEndian(static_cast<std::uint64_t>(record.size())));
  put(record);
  ++records_;
}

void ChunkFileWriter::commit() {
  put(littleEndian(kEnd));
  put(littleEndian(records_));
  put(littleEndian(hash_.value()));
  file_.commit();
}

ChunkFileReader::ChunkFileReader(const std::filesystem::path& path)
    : path_(path), stream_(path, std::ios::binary) {
  std::error_code error;
  left_ = std::filesystem::file_size(path, error);
  if (!stream_ || error) fail("it cannot be opened");
  std::array<std::uint8_t, kMagic.size()> magic{};
  get(magic);
  if (std::memcmp(magic.data(), kMagic.data(), magic.size()) != 0) fail("it does not begin as one");
}

void ChunkFileReader::fail(const char* why) const {
  throw Error(ExitCode::Transient, fmt::format("{} is no whole chunk of a video: {}", quoted(path_), why));
}

void ChunkFileReader::get(std::span<std::uint8_t> bytes) {
  if (bytes.size() > left_) fail("it ends too early");
  if (!stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    fail("it cannot be read");
  left_ -= bytes.size();
  hash_.add(bytes.data(), bytes.size());
}

bool ChunkFileReader::next(std::vector<std::uint8_t>& record) {
  std::array<std::uint8_t, 8> number{};
  get(number);
  const auto size = fromLittleEndian<std::uint64_t>(number);
  if (size != kEnd) {
    if (left_ < kTail || size > left_ - kTail) fail("it ends too early"); // before memory is taken
    record.resize(size);
    get(record);
    ++records_;
    return true;
  }
  get(number);
  if (fromLittleEndian<std::uint64_t>(number) != records_) fail("it lacks records");
  const std::uint64_t hash = hash_.value();
  get(number);
  if (fromLittleEndian<std::uint64_t>(number) != hash) fail("its checksum differs");
  if (left_ != 0) fail("it goes on after its end");
  return false;
}

bool isWholeChunk(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  try {
    ChunkFileReader reader(path);
    std::vector<std::uint8_t> record;
    while (reader.next(record)) {
    }
    return true;
  } catch (const Error&) {
    return false;
  }
}

} // namespace offstage
