#pragma once

#include <stdexcept>
#include <string>

namespace offstage {

/// What the program's exit status says. A server decides by it whether a retry can help.
enum class ExitCode : int {
  Done = 0,
  Differs = 1,       ///< a comparison differs
  BadInput = 2,      ///< bad usage or bad input: never worth a retry
  Environment = 3,   ///< a library, a codec or a font is missing; the message names the Debian package
  Transient = 75,    ///< disk full, killed worker: retrying may help (EX_TEMPFAIL of sysexits.h)
  Interrupted = 130, ///< ended by Ctrl-C (128 + SIGINT)
};

/// An error that is meant for the user: what() is a whole message without a trailing newline, and code() the
/// exit status that it leads to. Library users catch this one type.
class Error : public std::runtime_error {
public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

private:
  ExitCode code_;
};

} // namespace offstage
