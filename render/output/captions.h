#pragma once

#include "render/output/tracks.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// Captions as a WebVTT file (W3C WebVTT, section 4): milliseconds, in order of their starts; those that
/// overlap stand one above the other in players. One that no millisecond is left of is left out.
std::string webVtt(std::span<const Cue> cues);
/// The chapters as a WebVTT file, as a browser's <track kind="chapters"> takes it.
std::string webVtt(std::span<const Chapter> chapters);

/// A cue's text as WebVTT has it (section 4.2.2): & < > escaped, and a no-break space in empty lines, which
/// would end it.
std::string webVttText(std::string_view text);

/// Whether a file begins as those of webVtt() do, so that it may be replaced.
bool isOwnWebVtt(std::string_view bytes);

/// The same captions one after another, for a track that shows one at a time: where some overlap, a cue holds
/// the lines of all, in their order; where none is shown, a cue without text. A text is cut to the 65535
/// bytes that such a track can hold, behind a whole character. Covers 0 … `end` (ns) without a gap.
std::vector<Cue> withoutOverlaps(std::span<const Cue> cues, std::int64_t end);

} // namespace offstage
