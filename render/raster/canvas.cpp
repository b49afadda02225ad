#include "render/raster/canvas.h"

#include "render/raster/framebuffer.h"
#include "render/raster/gl_device.h"
#include "render/raster/instance_buffer.h"
#include "render/raster/pattern_texture.h"
#include "render/raster/shaders.h"
#include "src/sim/error.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Consecutive instances that one draw call paints.
struct Batch {
  ProgramKind program;
  std::size_t first;
  std::size_t count;
};

void requireSize(int width, int height, int most) {
  if (width >= 1 && height >= 1 && width <= most && height <= most) return;
  throw Error(ExitCode::BadInput, fmt::format("a frame of {}x{} px cannot be drawn: each side may be 1 to {}",
                                              width, height, most));
}

std::uint64_t nextDrawing() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

} // namespace

struct Canvas::Impl {
  Impl(std::shared_ptr<GlDevice> shared, int width, int height)
      : device(std::move(shared)),
        framebuffer(device->gl(), width, height),
        instances(device->gl()),
        shaders(device->gl(), width, height),
        patterns(device) {}

  void collect(const Picture& picture);
  void paint();

  std::shared_ptr<GlDevice> device;
  Framebuffer framebuffer;
  InstanceBuffer instances;
  Shaders shaders;
  PatternTexture patterns;
  std::vector<Batch> batches; ///< of the present frame; kept for its memory
};

/// Makes the picture's primitives into instances and batches, in their order.
void Canvas::Impl::collect(const Picture& picture) {
  instances.clear();
  batches.clear();
  const PixelRect clip{std::max(picture.clip.left, 0), std::max(picture.clip.top, 0),
                       std::min(picture.clip.right, picture.width),
                       std::min(picture.clip.bottom, picture.height)};
  if (clip.empty()) return;
  for (const Primitive& primitive : picture.primitives) {
    std::optional<Drawable> drawable = makeDrawable(primitive, clip, device->largestPoint());
    if (!drawable) continue;
    ProgramKind program{drawable->coverage, PaintSource::Color, drawable->footprint};
    if (primitive.pattern >= 0) {
      const PlacedPattern& pattern = picture.patterns.at(static_cast<std::size_t>(primitive.pattern));
      program.paint =
          patterns.place(pattern, drawable->instance) ? PaintSource::Reduced : PaintSource::Pattern;
    }
    if (batches.empty() || batches.back().program != program) {
      instances.fillVector();
      batches.push_back({program, instances.size(), 0});
    }
    instances.add(drawable->instance);
    batches.back().count = instances.size() - batches.back().first;
  }
  instances.fillVector();
}

void Canvas::Impl::paint() {
  const GlFunctions& gl = device->gl();
  instances.upload();
  patterns.bind();
  gl.enable(GL_BLEND);
  gl.enable(GL_PROGRAM_POINT_SIZE);
  gl.blendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // premultiplied source over premultiplied framebuffer
  for (const Batch& batch : batches) {
    shaders.use(batch.program);
    instances.draw(batch.program.footprint, batch.first, batch.count);
  }
}

Canvas::Canvas(int width, int height) {
  std::shared_ptr<GlDevice> device = GlDevice::shared();
  requireSize(width, height, device->maxSize());
  impl_ = std::make_unique<Impl>(std::move(device), width, height);
}

Canvas::~Canvas() = default;

void Canvas::draw(const Picture& picture, Frame& frame) {
  Impl& impl = *impl_;
  if (picture.width != impl.framebuffer.width() || picture.height != impl.framebuffer.height()) {
    throw Error(ExitCode::BadInput,
                fmt::format("a picture of {}x{} px was given to a canvas of {}x{} px", picture.width,
                            picture.height, impl.framebuffer.width(), impl.framebuffer.height()));
  }
  impl.collect(picture);
  impl.framebuffer.bind();
  impl.framebuffer.clear(picture.background);
  impl.paint();
  impl.framebuffer.read(frame, picture.background.a == 255);
  frame.id = nextDrawing();
  frame.base = 0;
  frame.damage.clear();
  checkGl(impl.device->gl(), "drawing a frame");
}

Canvas::Info Canvas::info() const {
  const GlDevice& device = *impl_->device;
  return {device.backend(), device.text(GL_RENDERER), device.text(GL_VERSION), device.maxSize()};
}

} // namespace offstage
