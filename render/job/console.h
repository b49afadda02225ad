#pragma once

#include <cstdio>
#include <string_view>

namespace offstage {

/// Writes to a stream that a person or a log reads: stderr, or stdout for a summary. That its reader has gone
/// away, or that its disk is full, is no reason to lose a render, so it fails in silence.
void say(std::FILE* stream, std::string_view text) noexcept;

/// Writes what the program still holds for standard output. Throws Error(Transient) when that, or anything
/// written to it before, did not arrive: a list that has been cut off must not look like a whole one. A
/// caller that has closed it wants no results.
void requireResultsWritten();

/// Gives standard input, output and error, where the caller has closed them, to /dev/null, so that no output
/// file takes their number and gets the messages. Each is opened the wrong way round (gnulib's stdopen does
/// so, too): using it is still the error that it was.
void occupyStandardStreams();

/// Columns of the terminal behind a stream; 80 when it does not say, 0 when it is none.
int terminalColumns(std::FILE* stream);

} // namespace offstage
