#pragma once

#include "render/output/libav.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace offstage {

/// A decoded picture of a video, in the video's own format.
struct VideoPicture {
  libav::VideoFrame frame;
  double time = 0.0; ///< s: when it is shown
};

/// Decodes the first video stream of a file, frame by frame in the order of showing.
class VideoReader {
public:
  /// Throws Error(BadInput) when the file cannot be read, holds no video or more than `maxPixels` a frame,
  /// and Error(Environment) when its codec is not installed. `threads`: of the decoder.
  VideoReader(const std::filesystem::path& file, std::int64_t maxPixels, int threads);

  /// The next picture; null at the end. Throws Error(BadInput) when the file is damaged or cut off.
  std::shared_ptr<const VideoPicture> next();

private:
  struct CloseInput {
    void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
  };

  [[noreturn]] void fail(const std::string& why) const;
  int check(int result, const char* what) const;
  void openDecoder(int threads);
  void requireAllowedSize(int width, int height) const;
  bool feed();
  void noteExactTime();

  std::filesystem::path file_;
  std::int64_t maxPixels_;
  std::unique_ptr<AVFormatContext, CloseInput> format_;
  libav::CodecContext decoder_;
  libav::Packet packet_;
  int stream_ = -1;
  bool drained_ = false;
  std::map<std::int64_t, double> exactTimes_; ///< s, of an .apng's frames to come, by libav's time stamp
  double apngTime_ = 0.0;                     ///< s: when its next frame is shown
};

/// Whether two pictures are equal byte for byte in size, format, colours' meaning and planes: then they are
/// equal however they are shown.
bool equalPictures(const VideoPicture& a, const VideoPicture& b);

/// Turns a video's pictures into RGBA. Keeps what it needs for pictures of one kind; not for two threads at
/// once.
class VideoConverter {
public:
  VideoConverter();
  ~VideoConverter();
  VideoConverter(const VideoConverter&) = delete;
  VideoConverter& operator=(const VideoConverter&) = delete;

  /// By the matrix and the range that the video names; where it names none, BT.709 from 720 rows on and
  /// BT.601 below, limited range. Valid until the next call.
  const Frame& convert(const VideoPicture& picture);

private:
  struct Scaler;
  void scale(const VideoPicture& picture);
  Frame frame_;
  std::unique_ptr<Scaler> scaler_;
};

} // namespace offstage
