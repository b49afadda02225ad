#include "render/output/atomic_file.h"

#include "render/output/file_error.h"
#include "render/output/temporary_registry.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <optional>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <climits>
#include <fmt/format.h>

namespace offstage {

namespace fs = std::filesystem;

namespace {

/// As many links as Linux itself follows before it says ELOOP.
constexpr int kMostLinks = 40;
/// Attempts to find a free temporary name: a killed process of the same id may have left some.
constexpr int kMostNames = 1000;

fs::path followLinks(const fs::path& path) {
  fs::path target = path;
  for (int link = 0; link < kMostLinks; ++link) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(target, error))) return target;
    const fs::path next = fs::read_symlink(target, error);
    if (error) throw fileError(error.value(), path);
    target = target.parent_path() / next; // an absolute `next` replaces the left side
  }
  throw fileError(ELOOP, path);
}

/// In a folder with the sticky bit, such as /tmp, a file that others may write to is still not theirs to
/// replace (sticky(7) of Debian's manual: the owner of the file, of the folder, and root).
bool mayReplace(const struct stat& file, const fs::path& folder) {
  struct stat info {};
  if (stat(folder.c_str(), &info) != 0 || (info.st_mode & S_ISVTX) == 0) return true;
  const uid_t self = geteuid();
  return self == 0 || self == file.st_uid || self == info.st_uid;
}

/// The permissions of the regular file at `target`, nothing when there is none. Throws when something else
/// stands there, or when the file may not be written.
std::optional<mode_t> permissionsOf(const fs::path& target, const fs::path& path) {
  struct stat info {};
  if (stat(target.c_str(), &info) != 0) {
    if (errno == ENOENT) return std::nullopt; // a missing folder shows when the temporary is opened
    throw fileError(errno, path);
  }
  if (S_ISDIR(info.st_mode)) throw fileError(EISDIR, path);
  if (!S_ISREG(info.st_mode)) {
    throw Error(ExitCode::BadInput,
                fmt::format("cannot write {}: it is a device, a pipe or a socket, not a file (use -o - "
                            "to write raw frames to standard output)",
                            quoted(path)));
  }
  if (access(target.c_str(), W_OK) != 0) {
    if (errno == EROFS) throw fileError(EROFS, path);
    throw Error(ExitCode::BadInput,
                fmt::format("cannot write {}: the file is write-protected", quoted(path)));
  }
  if (!mayReplace(info, folderOf(target))) {
    throw Error(ExitCode::BadInput,
                fmt::format("cannot write {}: in the folder {} only its owner may replace a file",
                            quoted(path), quoted(folderOf(target))));
  }
  return info.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO);
}

constexpr std::string_view kTemporaryEnding = ".partial";

/// `.NAME.PID.partial`; NAME is cut so that the whole is a legal name.
std::string temporaryName(const std::string& name, pid_t pid, int attempt) {
  const std::string suffix = attempt == 0 ? fmt::format(".{}{}", pid, kTemporaryEnding)
                                          : fmt::format(".{}.{}{}", pid, attempt, kTemporaryEnding);
  return fmt::format(".{}{}", shortened(name, NAME_MAX - suffix.size() - 1), suffix);
}

/// Removes a dot and digits from the end; false when there are none.
bool dropNumber(std::string_view& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot + 1 == name.size()) return false;
  if (name.find_first_not_of("0123456789", dot + 1) != std::string_view::npos) return false;
  name = name.substr(0, dot);
  return true;
}

/// Whether this is a temporary's name, with or without the number of an attempt, of a name that `isOurs`
/// accepts.
bool isTemporaryOf(std::string_view name, const NameTest& isOurs) {
  if (!name.starts_with('.') || !name.ends_with(kTemporaryEnding)) return false;
  // One that was cut is as long as a name can be, but for a UTF-8 character that would have been cut in two.
  constexpr std::size_t kLongestCharacter = 4;
  const bool maybeCut = name.size() > NAME_MAX - kLongestCharacter;
  name.remove_prefix(1);
  name.remove_suffix(kTemporaryEnding.size());
  const auto accepted = [&] { return isOurs(name, true) || (maybeCut && isOurs(name, false)); };
  return dropNumber(name) && (accepted() || (dropNumber(name) && accepted()));
}

} // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), owner_(getpid()) {
  if (path_.empty()) throw Error(ExitCode::BadInput, "cannot write a file without a name");
  if (!path_.has_filename()) throw fileError(EISDIR, path_);
  target_ = followLinks(path_);
  const std::optional<mode_t> permissions = permissionsOf(target_, path_);
  openTemporary();
  if (permissions && fchmod(descriptor_, *permissions) != 0) {
    const int error = errno;
    discard();
    throw fileError(error, target_);
  }
}

void AtomicFile::openTemporary() {
  const fs::path folder = folderOf(target_);
  for (int attempt = 0; attempt < kMostNames; ++attempt) {
    temporary_ = folder / temporaryName(target_.filename().native(), owner_, attempt);
    descriptor_ = open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
      // Tells removeAbandoned() that somebody is at work. Where a file system has no locks, it removes
      // nothing.
      flock(descriptor_, LOCK_EX | LOCK_NB);
      std::error_code error;
      const fs::path absolute = fs::absolute(temporary_, error);
      if (!error) record_ = registerTemporary(absolute.native());
      return;
    }
    if (errno != EEXIST && errno != EINTR) throw fileError(errno, target_);
  }
  throw Error(ExitCode::BadInput,
              fmt::format("cannot write {}: the folder {} is full of unfinished files such as {}; "
                          "remove them",
                          quoted(path_), quoted(folder), quoted(temporary_)));
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::discard() noexcept {
  if (descriptor_ < 0) return;
  close(descriptor_);
  descriptor_ = -1;
  if (getpid() != owner_) return;
  unlink(temporary_.c_str());
  unregisterTemporary(record_);
  record_ = nullptr;
}

void AtomicFile::write(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, bytes, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      throw fileError(errno, target_);
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

std::int64_t AtomicFile::seek(std::int64_t offset, int whence) {
  const off_t position = lseek(descriptor_, offset, whence);
  if (position < 0) throw fileError(errno, target_);
  return position;
}

void AtomicFile::commit(SyncFolder sync) {
  if (descriptor_ < 0 || getpid() != owner_) {
    throw std::logic_error("AtomicFile::commit: the file is not this process's, or was committed before");
  }
  while (fsync(descriptor_) != 0) {
    if (errno != EINTR) throw fileError(errno, target_);
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) throw fileError(errno, target_);
  unregisterTemporary(record_);
  record_ = nullptr;
  // The contents are on the disk already, so nothing is left that close could report.
  close(descriptor_);
  descriptor_ = -1;
  if (sync == SyncFolder::Yes) syncFolder(folderOf(target_));
}

void requireWritable(const fs::path& path) {
  const AtomicFile probe(path);
}

void removeAbandoned(const fs::path& folder, const NameTest& isOurs) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!isTemporaryOf(entry->path().filename().native(), isOurs)) continue;
    const int descriptor = open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(entry->path().c_str());
    close(descriptor);
  }
}

void removeAbandoned(const fs::path& file) {
  const fs::path place = placeOf(file);
  const std::string wanted = place.filename().native();
  removeAbandoned(place.parent_path(), [&](std::string_view name, bool whole) {
    return whole ? name == wanted : wanted.starts_with(name);
  });
}

void syncFolder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A folder may be written to without being readable, and some file systems sync no folders (EINVAL): the
  // file stands under its name all the same.
  if (descriptor < 0) return;
  int error = 0;
  while (fsync(descriptor) != 0) {
    error = errno;
    if (error != EINTR) break;
    error = 0;
  }
  close(descriptor);
  if (error != 0 && error != EINVAL) throw fileError(error, folder);
}

} // namespace offstage
