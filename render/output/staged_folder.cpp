#include "render/output/staged_folder.h"

#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/stream_hash.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {

namespace fs = std::filesystem;

namespace {

constexpr const char* kList = ".offstage";

std::string hashOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  StreamHash hash;
  std::string part(std::size_t{1} << 20U, '\0');
  while (stream.read(part.data(), static_cast<std::streamsize>(part.size())), stream.gcount() > 0)
    hash.add(part.data(), static_cast<std::size_t>(stream.gcount()));
  return fmt::format("{:016x}", hash.value());
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != kList) names.push_back(entry.path().filename().native());
  std::ranges::sort(names);
  return names;
}

/// A line a file: its hash, a blank, its name.
std::string listOf(const fs::path& folder) {
  std::string list = "made by offstage bundle\n";
  for (const std::string& name : namesIn(folder)) list += hashOf(folder / name) + ' ' + name + '\n';
  return list;
}

} // namespace

StagedFolder::StagedFolder(fs::path path) : path_(std::move(path)) {
  if (path_.filename().empty()) path_ = path_.parent_path();
  if (path_.filename().empty() || path_.filename() == "." || path_.filename() == "..")
    throw Error(ExitCode::BadInput, fmt::format("{} is no name for a new folder", quoted(path_)));
  requireReplaceable();
  temporary_ = folderOf(path_) / fmt::format(".{}.{}.partial", path_.filename().native(), getpid());
  std::error_code error;
  if (!fs::create_directory(temporary_, error)) throw fileError(error ? error.value() : EEXIST, path_);
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void StagedFolder::requireReplaceable() const {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path_, error);
  if (!fs::exists(status)) return;
  const auto refuse = [this](const std::string& why) {
    throw Error(ExitCode::BadInput,
                fmt::format("{} {}: move it away, or choose another name", quoted(path_), why));
  };
  if (!fs::is_directory(status)) refuse("is there and is no folder");
  if (fs::is_empty(path_, error) && !error) return;
  std::ifstream stream(path_ / kList, std::ios::binary);
  if (!stream) refuse("is a folder that offstage has not made");
  const std::string list(std::istreambuf_iterator<char>(stream), {});
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error))
    if (!fs::is_regular_file(entry.symlink_status()))
      refuse(fmt::format("holds {}, which offstage has not made", quoted(entry.path().filename())));
  if (error || list != listOf(path_)) refuse("holds files that have come or changed since offstage made it");
}

void StagedFolder::commit() {
  const std::string files = listOf(temporary_);
  AtomicFile list(temporary_ / kList);
  list.write(files);
  list.commit();
  requireReplaceable(); // it may have changed meanwhile
  std::error_code ignored;
  const bool there = fs::exists(path_, ignored);
  // With RENAME_EXCHANGE both folders have a name all the time, and what was replaced then bears the
  // temporary one.
  const int result = renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(),
                               there ? RENAME_EXCHANGE : RENAME_NOREPLACE);
  if (result != 0) throw fileError(errno, path_);
  syncFolder(folderOf(path_));
}

} // namespace offstage
