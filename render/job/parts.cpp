#include "render/job/parts.h"

#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/stream_hash.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

#include <climits>
#include <fmt/format.h>

namespace offstage {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kFolderEnding = ".parts";
constexpr const char* kLock = "lock";
constexpr const char* kManifest = "manifest";
constexpr std::string_view kChunkEnding = ".chunk";
constexpr std::string_view kHashEnding = ".hash";
constexpr std::string_view kTemporaryEnding = ".partial";
/// A run that was killed is gone after this time, and its workers with it.
constexpr auto kPatience = std::chrono::milliseconds(1500);
constexpr auto kBetweenTries = std::chrono::milliseconds(20);

bool isNumbered(std::string_view name, std::string_view ending) {
  if (!name.ends_with(ending) || name.size() == ending.size()) return false;
  name.remove_suffix(ending.size());
  return std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

bool isTemporary(std::string_view name) {
  return name.starts_with('.') && name.ends_with(kTemporaryEnding);
}

bool isOwn(std::string_view name) {
  return name == kLock || name == kManifest || isNumbered(name, kChunkEnding) ||
         isNumbered(name, kHashEnding) || isTemporary(name);
}

/// A file and no link, nor anything that hangs when it is opened; or gone meanwhile, with another run's end.
bool isPlain(const fs::path& path) {
  std::error_code ignored;
  const fs::file_type type = fs::symlink_status(path, ignored).type();
  return type == fs::file_type::regular || type == fs::file_type::not_found;
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename().native());
  return names;
}

} // namespace

fs::path Parts::folderFor(const fs::path& out) {
  const std::string name = out.filename().native();
  if (name.size() + kFolderEnding.size() <= NAME_MAX)
    return out.parent_path() / fmt::format("{}{}", name, kFolderEnding);
  StreamHash hash; // keeps apart what begins alike
  hash.add(name.data(), name.size());
  const std::string ending = fmt::format(".{:016x}{}", hash.value(), kFolderEnding);
  return out.parent_path() / fmt::format("{}{}", shortened(name, NAME_MAX - ending.size()), ending);
}

fs::path Parts::manifestFor(const fs::path& out) {
  return folderFor(out) / kManifest;
}

Parts::Parts(const fs::path& out, const Manifest& manifest, Use use, bool resume)
    : folder_(folderFor(out)), use_(use), owner_(getpid()) {
  std::error_code error;
  if (!fs::create_directory(folder_, error) && error) {
    if (!fs::exists(fs::symlink_status(folder_, error))) throw fileError(error.value(), folder_);
  }
  requireOwn();
  lock(manifest);
  try {
    takeOver(manifest, resume);
  } catch (...) {
    letGo();
    throw;
  }
}

Parts::~Parts() {
  if (lock_ < 0 || getpid() != owner_) return;
  if (use_ == Use::Whole) removeTemporaries();
  letGo();
}

/// A folder without a chunk goes, too.
void Parts::letGo() {
  const std::vector<std::string> names = namesIn(folder_);
  const bool empty =
      std::ranges::none_of(names, [](const std::string& name) { return isNumbered(name, kChunkEnding); });
  if (empty && tryLock(LOCK_EX)) removeAll();
  if (lock_ >= 0) close(lock_);
}

void Parts::requireOwn() const {
  std::error_code error;
  if (!fs::is_directory(folder_, error)) {
    throw Error(ExitCode::BadInput,
                fmt::format("the unfinished parts of the output go to the folder {}, but something "
                            "else has that name: move it away",
                            quoted(folder_)));
  }
  for (const std::string& name : namesIn(folder_)) {
    const bool foreign = name == kManifest && Manifest::isForeign(folder_ / name);
    if (isOwn(name) && !foreign && isPlain(folder_ / name)) continue;
    throw Error(ExitCode::BadInput,
                fmt::format("the unfinished parts of the output go to the folder {}, but it holds "
                            "{}, which is none of them: move it away",
                            quoted(folder_), quoted(fs::path(name))));
  }
}

bool Parts::tryLock(int operation) {
  return flock(lock_, operation | LOCK_NB) == 0;
}

void Parts::lock(const Manifest& manifest) {
  const fs::path file = folder_ / kLock;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (true) {
    lock_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno == ENOENT) { // another run has just ended and removed the folder
      std::error_code ignored;
      fs::create_directory(folder_, ignored);
    } else if (lock_ < 0) {
      throw fileError(errno, file);
    } else {
      // A segment may share a folder that is already of the same render, else it has to make it so alone.
      const bool share = use_ == Use::Segment && Manifest::read(folder_ / kManifest) == manifest;
      struct stat mine {};
      struct stat there {};
      if (tryLock(share ? LOCK_SH : LOCK_EX) && fstat(lock_, &mine) == 0 && stat(file.c_str(), &there) == 0 &&
          mine.st_ino == there.st_ino)
        return;
      close(lock_);
      lock_ = -1;
    }
    if (std::chrono::steady_clock::now() > deadline) break;
    std::this_thread::sleep_for(kBetweenTries);
  }
  throw Error(ExitCode::Transient,
              fmt::format("another run is making this output (it holds {})", quoted(file)));
}

void Parts::takeOver(const Manifest& manifest, bool resume) {
  const std::optional<Manifest> there = Manifest::read(folder_ / kManifest);
  const std::vector<std::string> names = namesIn(folder_);
  const bool any =
      std::ranges::any_of(names, [](const std::string& name) { return isNumbered(name, kChunkEnding); });
  if (resume && there == manifest) {
    if (use_ == Use::Whole) removeTemporaries();
  } else {
    if (any && resume)
      notice_ =
          fmt::format("starting over: {} holds parts of another render, {}", quoted(folder_),
                      there ? "which differs in " + there->differences(manifest) : "without a manifest");
    if (!tryLock(LOCK_EX)) // a segment that shares the folder must not empty it
      throw Error(ExitCode::Transient, fmt::format("other segments are being made in {}", quoted(folder_)));
    removeOwn();
    AtomicFile file(folder_ / kManifest);
    file.write(manifest.text());
    file.commit();
  }
  if (use_ == Use::Segment) tryLock(LOCK_SH);
}

fs::path Parts::chunk(std::int64_t index) const {
  return folder_ / fmt::format("{:06}{}", index, kChunkEnding);
}

fs::path Parts::hashes(std::int64_t index) const {
  return folder_ / fmt::format("{:06}{}", index, kHashEnding);
}

void Parts::drop(std::int64_t index) {
  std::error_code ignored;
  fs::remove(chunk(index), ignored);
  fs::remove(hashes(index), ignored);
}

void Parts::removeTemporaries() const {
  std::error_code ignored;
  for (const std::string& name : namesIn(folder_))
    if (isTemporary(name)) fs::remove(folder_ / name, ignored);
}

void Parts::removeOwn() const {
  std::error_code ignored;
  for (const std::string& name : namesIn(folder_))
    if (isOwn(name) && name != kLock && name != kManifest) fs::remove(folder_ / name, ignored);
  // Behind the chunks: whoever is killed in between leaves some that say what they are of.
  fs::remove(folder_ / kManifest, ignored);
}

void Parts::removeAll() {
  removeOwn();
  // Last: whoever comes when the lock's file is gone makes another and holds it at once.
  std::error_code ignored;
  fs::remove(folder_ / kLock, ignored);
  fs::remove(folder_, ignored); // not if someone has come
  close(lock_);
  lock_ = -1;
}

} // namespace offstage
