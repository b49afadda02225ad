#include "render/output/file_error.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fmt/format.h>

namespace offstage {

namespace {

struct Reason {
  ExitCode code;
  std::string text;
};

Reason reasonOf(int error, const std::filesystem::path& path) {
  const std::string folder = quoted(folderOf(path));
  switch (error) {
  case ENOSPC:
    return {ExitCode::Transient, "no space left on the disk that holds " + folder};
  case EDQUOT:
    return {ExitCode::Transient, "no space left on the disk that holds " + folder + " (quota exceeded)"};
  case EFBIG:
    return {ExitCode::Transient, "the file grew past the largest size allowed here (see ulimit -f)"};
  case EIO:
    return {ExitCode::Transient, "input/output error on the disk that holds " + folder};
  case ENOENT:
    return {ExitCode::BadInput, "the folder " + folder + " does not exist"};
  case ENOTDIR:
    return {ExitCode::BadInput, "a part of " + folder + " is not a folder"};
  case EACCES:
  case EPERM:
    return {ExitCode::BadInput, "no permission to write in the folder " + folder};
  case EISDIR: {
    std::error_code ignored;
    const bool isThere = path.has_filename() || std::filesystem::exists(path, ignored);
    return {ExitCode::BadInput, isThere ? "it is a folder" : "a name that ends in / names a folder"};
  }
  case EROFS:
    return {ExitCode::BadInput, "the folder " + folder + " is on a read-only file system"};
  case ENAMETOOLONG:
    return {ExitCode::BadInput, "the name is too long"};
  case ELOOP:
    return {ExitCode::BadInput, "its symbolic links lead in a circle"};
  default:
    return {ExitCode::Transient, std::generic_category().message(error)};
  }
}

} // namespace

Error fileError(int error, const std::filesystem::path& path) {
  const Reason reason = reasonOf(error, path);
  return {reason.code, fmt::format("cannot write {}: {}", quoted(path), reason.text)};
}

Error standardOutputError(int error) {
  if (error == EPIPE)
    return {ExitCode::Transient, "the program that reads from standard output has closed the pipe"};
  if (error == ENOSPC || error == EDQUOT)
    return {ExitCode::Transient, "cannot write to standard output: no space left on its disk"};
  return {error == EBADF ? ExitCode::BadInput : ExitCode::Transient,
          fmt::format("cannot write to standard output: {}", std::generic_category().message(error))};
}

std::string quoted(const std::filesystem::path& path) {
  std::string text = "'";
  text += path.native();
  text += '\'';
  return text;
}

std::string_view shortened(std::string_view name, std::size_t most) {
  std::size_t length = std::min(name.size(), most);
  while (length > 0 && length < name.size() && (static_cast<unsigned char>(name[length]) & 0xC0U) == 0x80U)
    --length;
  return name.substr(0, length);
}

std::filesystem::path placeOf(const std::filesystem::path& path) {
  const std::filesystem::path whole = std::filesystem::absolute(path);
  std::error_code error; // a name too long, a loop of links: whoever opens it will say so
  std::filesystem::path place = std::filesystem::weakly_canonical(whole, error);
  return error ? whole.lexically_normal() : place;
}

std::filesystem::path folderOf(const std::filesystem::path& path) {
  std::filesystem::path folder = path.parent_path();
  return folder.empty() ? "." : folder;
}

} // namespace offstage
