#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace offstage {

/// What an output's name asks for.
enum class OutputKind : std::uint8_t {
  RawPipe, ///< "-": RGBA to standard output
  RawFile, ///< .raw: RGBA
  Mp4,
  Mov,
  Matroska,
  WebM,
  Gif,
  Apng,
  PngSequence, ///< a printf pattern that ends in .png
};

/// A name's ending, ".mp4", in lower case.
std::string lowerCaseEnding(const std::filesystem::path& out);

/// By the name's ending, upper or lower case. Throws Error(BadInput) for another ending, and for a .png
/// without a place for a number.
OutputKind outputKind(const std::filesystem::path& out);

/// Videos hold sound; all others show only.
bool holdsSound(OutputKind kind);

/// Raw outputs are written front to back by one process; all others are made in chunks.
bool isStream(OutputKind kind);

/// The Error(BadInput) of an output that cannot hold a transparent background; `what` begins the message.
/// Names those that can.
[[noreturn]] void refuseTransparency(const std::filesystem::path& out, std::string_view what);

/// The Error(BadInput) of --quality with an output that has one quality only.
[[noreturn]] void refuseQuality(const std::filesystem::path& out, std::string_view why);

} // namespace offstage
