#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace offstage {

/// A file that appears under its name whole or not at all: written under a temporary name in the same folder,
/// then fsync and rename. Destroyed without commit(), it removes the temporary and leaves an older file of
/// that name as it was.
class AtomicFile {
public:
  /// Opens the temporary file. Throws Error(BadInput) when `path` is a folder, its folder is missing or may
  /// not be written to; Error(Transient) when the disk is full.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data,
             std::size_t size); ///< appends at the present position; throws as the constructor
  void write(std::string_view text) { write(text.data(), text.size()); }
  std::int64_t seek(std::int64_t offset, int whence); ///< as lseek; the new position
  void commit();                                      ///< fsync, rename, fsync of the folder

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
};

} // namespace offstage
