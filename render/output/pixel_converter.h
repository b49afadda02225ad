#pragma once

#include "render/output/libav.h"
#include "render/raster/frame.h"

#include <memory>

namespace offstage {

/// Puts frames into an encoder's pictures of one pixel format. The picture is at least as large as the frame
/// and must still hold what the call before put there: of a frame that tells what changed (Frame::damage)
/// only that is converted.
class PixelConverter {
public:
  virtual ~PixelConverter() = default;
  PixelConverter() = default;
  PixelConverter(const PixelConverter&) = delete;
  PixelConverter& operator=(const PixelConverter&) = delete;
  virtual void convert(const Frame& frame, AVFrame& picture) = 0;
};

/// Of YUV420P and YUVA420P (yuv.h; alpha as it is), YUVA444P10 (BT.709 in limited range, alpha in full
/// range), BGR0 and BGRA (values as they are). Throws std::logic_error for another format.
std::unique_ptr<PixelConverter> makePixelConverter(AVPixelFormat format);

} // namespace offstage
