#include "render/output/chunked_output.h"

#include "render/output/apng_output.h"
#include "render/output/frame_check.h"
#include "render/output/gif_output.h"
#include "render/output/output_kind.h"
#include "render/output/png_sequence.h"
#include "render/output/video_output.h"

#include <stdexcept>

namespace offstage {

std::unique_ptr<ChunkedOutput> makeChunkedOutput(const std::filesystem::path& out, const SinkFormat& format) {
  const OutputKind kind = outputKind(out);
  requirePictureSize(format.width, format.height);
  switch (kind) {
  case OutputKind::Mp4:
    return std::make_unique<VideoOutput>(out, Container::Mp4, format);
  case OutputKind::Mov:
    return std::make_unique<VideoOutput>(out, Container::Mov, format);
  case OutputKind::Matroska:
    return std::make_unique<VideoOutput>(out, Container::Matroska, format);
  case OutputKind::WebM:
    return std::make_unique<VideoOutput>(out, Container::WebM, format);
  case OutputKind::PngSequence:
    return std::make_unique<PngSequenceOutput>(out, format);
  case OutputKind::Gif:
    return std::make_unique<GifOutput>(out, format);
  case OutputKind::Apng:
    return std::make_unique<ApngOutput>(out, format);
  case OutputKind::RawPipe:
  case OutputKind::RawFile:
    break;
  }
  throw std::logic_error("makeChunkedOutput: a raw output is written front to back");
}

} // namespace offstage
