#pragma once

namespace offstage {

/// Makes Ctrl-C (SIGINT), SIGTERM and, unless it is ignored, SIGHUP (a terminal that is closed) end the
/// program cleanly: the first one is noted, and the loop that draws frames ends at the next frame, so that
/// temporary files go; a second one removes them at once and ends the process. SIGPIPE and SIGXFSZ are
/// ignored, so that a closed pipe and a file size limit become error messages instead of a silent death.
void installSignalHandlers();

/// Throws Error with code 128 + signal (130 after Ctrl-C) when a signal has come.
void throwIfInterrupted();

} // namespace offstage
