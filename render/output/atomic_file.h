#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>
#include <sys/types.h>

namespace offstage {

struct TemporaryRecord;

/// A file that appears under its name whole or not at all: written under a temporary name in the same folder,
/// then fsync and rename. Destroyed without commit(), it removes the temporary and leaves an older file of
/// that name as it was.
///
/// The temporary is hidden, bears the process id: `.NAME.PID.partial` (of a long NAME only the beginning),
/// and is locked (flock) while it lasts. A name that is a symbolic link is followed, as a shell's `>` does:
/// the link stays, and what it points to is replaced. The new file has the permissions of the file it
/// replaces, or 0666 less the umask. A process forked meanwhile holds a copy that neither removes the
/// temporary nor may commit it.
class AtomicFile {
public:
  /// Opens the temporary file. Throws Error(BadInput) when `path` is empty, a folder, a device, a pipe or a
  /// write-protected file, or its folder is missing or may not be written to; Error(Transient) when the disk
  /// is full.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Writes all bytes at the present position; throws as the constructor.
  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  std::int64_t seek(std::int64_t offset, int whence); ///< as lseek; the new position

  /// Whether commit() also waits until the folder's new entry is on the disk. Without it the file's contents
  /// are still on the disk before its name is; a writer of many files syncs their folder once, at the end.
  enum class SyncFolder { Yes, No };
  /// fsync, rename, fsync of the folder. Once; nothing may be written afterwards.
  void commit(SyncFolder syncFolder = SyncFolder::Yes);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

private:
  void openTemporary();
  void discard() noexcept;

  std::filesystem::path path_;   ///< as given; for messages
  std::filesystem::path target_; ///< path_ with its symbolic links followed
  std::filesystem::path temporary_;
  int descriptor_ = -1;
  pid_t owner_ = 0;
  TemporaryRecord* record_ = nullptr;
};

/// Checks what AtomicFile's constructor checks, without leaving anything behind: for programs that want to
/// know before a long computation whether its result can be written.
void requireWritable(const std::filesystem::path& path);

/// Tells a file by its name, or, with `whole` = false, by how its name begins: a temporary's name that would
/// be too long holds no more of it.
using NameTest = std::function<bool(std::string_view name, bool whole)>;

/// Removes from `folder` the temporaries that killed processes have left of files whose names `isOurs`
/// accepts. Those of living processes stay: each holds a lock on its own.
void removeAbandoned(const std::filesystem::path& folder, const NameTest& isOurs);
/// The same of one file.
void removeAbandoned(const std::filesystem::path& file);

/// Waits until the folder's entries are on the disk.
void syncFolder(const std::filesystem::path& folder);

/// Removes the temporary files of every AtomicFile of this process: the last resort of a signal handler that
/// ends the process at once, where no destructor runs. Async-signal-safe. No AtomicFile may be used
/// afterwards.
void removeTemporariesFromSignalHandler() noexcept;

} // namespace offstage
