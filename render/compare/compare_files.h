#pragma once

#include "render/compare/comparison.h"
#include "render/compare/report.h"
#include "render/draw/png_reader.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace offstage {

/// How files are compared, and what is made on the way.
struct CompareOptions {
  Tolerance tolerance;
  Metrics metrics = Metrics::Fast;
  std::int64_t maxPixels = kDefaultMaxPixels;
  bool pictures = false;     ///< for an HTML report
  bool strip = false;        ///< of a sequence: of its worst frame
  std::optional<double> fps; ///< gives frames without a time of their own one
};

struct CompareResult {
  Report report;
  std::optional<Frame> strip;
};

/// What a path names, for choosing how to compare it.
enum class InputKind {
  Picture,  ///< a PNG, JPEG or BMP
  Sequence, ///< a folder of pictures or a pattern such as frames/%06d.png
  Video,
  Trace, ///< a CSV or JSON lines of a motion, see Trace
};
/// Throws Error(BadInput) when there is nothing of that name.
InputKind inputKind(const std::filesystem::path& path);

/// Compares two pictures. Throws Error(BadInput) for a file that cannot be read or is damaged in any way.
CompareResult comparePictures(const std::filesystem::path& expected, const std::filesystem::path& actual,
                              const CompareOptions& options);

/// Compares two sequences frame by frame, each a folder, a pattern or a video. Folders are paired by name, or
/// by order when they share none; everything else by order. Frames that only one of them has make the frame
/// count differ. Errors as above.
CompareResult compareSequences(const std::filesystem::path& expected, const std::filesystem::path& actual,
                               const CompareOptions& options);

} // namespace offstage
