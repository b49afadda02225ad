#include "render/output/sink.h"

#include "render/output/frame_check.h"
#include "render/output/output_kind.h"
#include "render/output/raw_sink.h"

#include <stdexcept>
#include <unistd.h>

namespace offstage {

std::unique_ptr<Sink> makeSink(const std::filesystem::path& out, const SinkFormat& format) {
  const OutputKind kind = outputKind(out);
  requirePictureSize(format.width, format.height);
  if (format.quality && *format.quality != Quality::Lossless)
    refuseQuality(out, "raw frames have one quality");
  if (kind == OutputKind::RawPipe) return std::make_unique<RawPipeSink>(STDOUT_FILENO, format);
  if (kind == OutputKind::RawFile) return std::make_unique<RawFileSink>(out, format);
  throw std::logic_error("makeSink: this output is made in chunks");
}

} // namespace offstage
