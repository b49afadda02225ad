#include "render/raster/canvas.h"

#include "render/raster/cover.h"
#include "render/raster/damage.h"
#include "render/raster/display_list.h"
#include "render/raster/draw_queue.h"
#include "render/raster/framebuffer.h"
#include "render/raster/gl_device.h"
#include "render/raster/ground_check.h"
#include "render/raster/partial_redraw.h"
#include "src/sim/error.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

void requireSize(int width, int height, int most) {
  if (width >= 1 && height >= 1 && width <= most && height <= most) return;
  throw Error(ExitCode::BadInput, fmt::format("a frame of {}x{} px cannot be drawn: each side may be 1 to {}",
                                              width, height, most));
}

/// About how many pixels a changed layer damages: of a large one that moved a little, those near its edge; of
/// a line, those near it.
std::int64_t touchedPixels(const DisplayList& list, std::int32_t index) {
  if (index < 0) return 0;
  constexpr std::int64_t kEdge = 2 * TileSet::kTile;
  const PixelRect bounds =
      list.layers[static_cast<std::size_t>(index)].bounds(); // empty when it is not visible
  const std::int64_t width = bounds.right - bounds.left;
  const std::int64_t height = bounds.bottom - bounds.top;
  const Primitive& primitive = list.primitives[static_cast<std::size_t>(index)];
  using Kind = Primitive::Kind;
  const bool narrow = isPlain(primitive) || primitive.kind >= Kind::Quad || primitive.kind == Kind::Ring ||
                      primitive.kind == Kind::BoxRing; // lines
  return narrow ? std::min(width * height, 2 * (width + height) * kEdge) : width * height;
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
        patterns(device),
        queue(device->gl(), width, height),
        tiles(width, height) {}

  void draw(const Picture& picture);
  bool collectDamage(const Rgba8& background);
  bool groundIsExact(Rgba8 background);
  void collectAll();

  std::shared_ptr<GlDevice> device;
  Framebuffer framebuffer;
  PatternTexture patterns;
  DrawQueue queue;

  DisplayList shown; ///< what the framebuffer holds, when `drawing` is not 0
  DisplayList next;  ///< being drawn
  std::vector<LayerChange> changes;
  TileSet tiles;
  PartialRedraw partial;
  GroundCheck ground;
  std::vector<PixelRect> damage; ///< of the last drawing, disjoint; meaningless when `whole`
  bool whole = true;             ///< the last drawing may have changed every pixel
  std::uint64_t drawing = 0;     ///< the last drawing's id
};

/// Finds what of `next` must be drawn and queues that. False when it is best to draw everything.
bool Canvas::Impl::collectDamage(const Rgba8& background) {
  const bool known = drawing != 0 && shown.background == background && shown.clip == next.clip;
  if (!known) return false;
  const std::int64_t pixels = std::int64_t{framebuffer.width()} * framebuffer.height();
  std::int64_t touched = 0;
  for (const LayerChange& change : changes) {
    touched += touchedPixels(shown, change.before) + touchedPixels(next, change.after);
    if (2 * touched > pixels) return false; // finding the tiles would not pay
  }
  tiles.clear();
  findDamage(shown, next, changes, tiles);
  const bool exact = groundIsExact(background);
  damage.clear();
  tiles.appendRuns(damage);
  const PartialRedraw::Target target{framebuffer.width(), framebuffer.height(), device->largestPoint(),
                                     exact};
  return partial.collect(next, tiles, target, queue);
}

/// Whether discs may be laid over the background without blending. The first time, that is tried out in the
/// framebuffer, whose tiles there are then drawn again.
bool Canvas::Impl::groundIsExact(Rgba8 background) {
  if (!GroundCheck::possible(framebuffer, background) || tiles.empty()) return false;
  if (!ground.known(background)) {
    framebuffer.bind();
    ground.run(framebuffer, background, patterns, queue);
    for (int top = 0; top < GroundCheck::kTrial.bottom; top += TileSet::kTile)
      for (int left = 0; left < GroundCheck::kTrial.right; left += TileSet::kTile) tiles.addTile(left, top);
  }
  return *ground.known(background);
}

void Canvas::Impl::collectAll() {
  for (const Layer& layer : next.layers)
    if (layer.visible) queue.add(layer.program, layer.instance);
}

void Canvas::Impl::draw(const Picture& picture) {
  try {
    updateDisplayList(picture, device->largestPoint(), shown, patterns, next, changes);
    queue.clear();
    whole = !collectDamage(picture.background);
    if (whole) {
      queue.clear();
      collectAll();
    }
    framebuffer.bind();
    if (whole) framebuffer.clear(picture.background);
    queue.paint(patterns);
  } catch (...) {
    drawing = 0; // what the framebuffer holds is not known any more
    throw;
  }
  std::swap(shown, next);
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
  const std::uint64_t before = impl.drawing;
  impl.draw(picture);
  const bool opaque = picture.background.a == 255;
  if (impl.whole || frame.id != before || !impl.framebuffer.fits(frame)) {
    impl.framebuffer.read(frame, opaque);
  } else {
    for (const PixelRect& rect : impl.damage) impl.framebuffer.read(frame, rect, opaque);
  }
  checkGl(impl.device->gl(), "drawing a frame");
  impl.drawing = nextDrawing();
  frame.id = impl.drawing;
  frame.base = impl.whole ? 0 : before;
  frame.damage = impl.damage;
  if (impl.whole) frame.damage.clear();
}

void Canvas::forget() {
  impl_->drawing = 0;
}

Canvas::Info Canvas::info() const {
  const GlDevice& device = *impl_->device;
  return {device.backend(), device.text(GL_RENDERER), device.text(GL_VERSION), device.maxSize()};
}

} // namespace offstage
