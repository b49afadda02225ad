#pragma once

#include "src/sim/error.h"

#include <filesystem>
#include <string>

namespace offstage {

/// The Error that a failed system call on a file of the user leads to. `error` is errno. What can never work
/// (no such folder, no permission, a read-only disk) is BadInput; a full disk, a quota, an I/O error and a
/// lack of descriptors or memory are Transient. The message is "cannot write 'PATH': REASON".
Error fileError(int error, const std::filesystem::path& path);

/// 'PATH', as messages quote file names.
std::string quoted(const std::filesystem::path& path);

/// The folder that `path` lies in; "." for a bare name.
std::filesystem::path folderOf(const std::filesystem::path& path);

} // namespace offstage
