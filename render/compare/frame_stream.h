#pragma once

#include "render/compare/video_reader.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace offstage {

/// One frame of a sequence before its pixels are asked for: a file, a video's picture, or neither, where the
/// other sequence has a frame that this one lacks.
struct StreamFrame {
  std::string name;           ///< "0012.png"; empty for a video's
  std::optional<double> time; ///< s; a video's, or by --fps
  std::filesystem::path file;
  std::shared_ptr<const VideoPicture> video;

  [[nodiscard]] bool absent() const { return file.empty() && !video; }
};

/// The frames of a sequence, one after the other.
class FrameStream {
public:
  FrameStream() = default;
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;
  virtual ~FrameStream() = default;
  /// Nothing at the end.
  virtual std::optional<StreamFrame> next() = 0;
};

/// Opens two sequences (folders, patterns, videos) so that their n-th frames belong together. Pictures in two
/// folders are paired by name, or by order when no name is in both; numbered pictures by number. Throws
/// Error(BadInput) when there are no pictures, or as VideoReader.
std::pair<std::unique_ptr<FrameStream>, std::unique_ptr<FrameStream>>
openStreams(const std::filesystem::path& expected, const std::filesystem::path& actual,
            std::int64_t maxPixels, std::optional<double> fps, int threads);

/// Whether a name is a pattern of numbered pictures (it has a %d and no file is called so).
bool isFramePattern(const std::filesystem::path& path);

} // namespace offstage
