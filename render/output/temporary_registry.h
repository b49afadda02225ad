#pragma once

#include <string>

namespace offstage {

/// A temporary file that is to go when a signal ends the process.
struct TemporaryRecord;

/// Remembers a file under its absolute path. Null when the path is longer than PATH_MAX: then only the
/// destructor of its owner removes it.
TemporaryRecord* registerTemporary(const std::string& absolutePath);

/// Forgets it again: it was renamed or removed. Null is allowed.
void unregisterTemporary(TemporaryRecord* record) noexcept;

} // namespace offstage
