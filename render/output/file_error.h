#pragma once

#include "src/sim/error.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace offstage {

/// The Error that a failed system call on a file of the user leads to. `error` is errno. What can never work
/// (no such folder, no permission, a read-only disk) is BadInput; a full disk, a quota, an I/O error and a
/// lack of descriptors or memory are Transient. The message is "cannot write 'PATH': REASON".
Error fileError(int error, const std::filesystem::path& path);

/// The same for standard output: Transient when its reader has gone away or its disk is full, BadInput when
/// the caller has closed it (EBADF).
Error standardOutputError(int error);

/// 'PATH', as messages quote file names.
std::string quoted(const std::filesystem::path& path);

/// A file's name, cut to so many bytes at most, and not within a UTF-8 character.
std::string_view shortened(std::string_view name, std::size_t most);

/// The folder that `path` lies in; "." for a bare name.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// The place that a name means, from the root on and without links, as far as it is there: two names of one
/// file have one. (std::filesystem::weakly_canonical() alone leaves a relative name as it is when nothing of
/// it is there yet.)
std::filesystem::path placeOf(const std::filesystem::path& path);

} // namespace offstage
