#pragma once

#include "render/output/atomic_file.h"
#include "render/output/stream_hash.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

namespace offstage {

/// A chunk's file: records of any bytes, then their number and an XXH3-64 of everything before, so that a
/// file that was cut, damaged or only half copied from another machine is told from a whole one. Appears
/// whole or not at all.
class ChunkFileWriter {
public:
  explicit ChunkFileWriter(const std::filesystem::path& path);

  void add(std::span<const std::uint8_t> record);
  void commit();
  [[nodiscard]] std::int64_t bytesWritten() const { return bytes_; }

private:
  void put(std::span<const std::uint8_t> bytes);

  AtomicFile file_;
  StreamHash hash_;
  std::int64_t bytes_ = 0;
  std::uint64_t records_ = 0;
};

/// Reads the records of a chunk's file. Throws Error(Transient) when it is not whole: made again, it will be.
class ChunkFileReader {
public:
  explicit ChunkFileReader(const std::filesystem::path& path);

  /// The next record, valid until the next call; false after the last one, when the checksum has been
  /// compared.
  bool next(std::vector<std::uint8_t>& record);

private:
  [[noreturn]] void fail(const char* why) const;
  void get(std::span<std::uint8_t> bytes);

  std::filesystem::path path_;
  std::ifstream stream_;
  StreamHash hash_;
  std::uint64_t left_ = 0; ///< bytes of the file that are not read yet
  std::uint64_t records_ = 0;
};

/// Whether a whole chunk file stands there.
bool isWholeChunk(const std::filesystem::path& path);

} // namespace offstage
