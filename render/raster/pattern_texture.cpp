#include "render/raster/pattern_texture.h"

#include "render/raster/area_reduce.h"
#include "render/raster/image_detail.h"
#include "src/sim/error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr int kTexelBytes = 4;
constexpr int kFirstCapacity = 1 << 16; // texels: 256 KiB

/// From this loss on (imageDetail: of 255), an image drawn smaller is averaged.
constexpr double kVisibleDetail = 32.0;

/// How many texels of the image, along an axis, a pixel averages when `reduction` texels fall to it. `fine`:
/// the image's detail is lost at this reduction.
///
/// All of them would be the mean over the pixel's area, which neither aliases nor shimmers, but is not
/// JavaFX's look: JavaFX interpolates between neighbouring texels at any reduction, and the mean differs from
/// that by up to 55/255 at 3.2:1 and 51/255 at 8:1 (oracle stills 09 and 08), where 26 are allowed. So an
/// image whose detail survives shows, up to 8:1, what JavaFX shows; from there to 16:1 the window grows to
/// the pixel's area, and stays that. An image with finer detail would shimmer as it moves, and is averaged
/// from 1:1 on.
double averagedTexels(double reduction, bool fine) {
  constexpr double kInterpolatedUpTo = 8.0;
  constexpr double kAveragedFrom = 16.0;
  if (fine || reduction >= kAveragedFrom) return std::max(reduction, 1.0);
  const double part = (reduction - kInterpolatedUpTo) / (kAveragedFrom - kInterpolatedUpTo);
  return part <= 0.0 ? 1.0 : 1.0 + part * (reduction - 1.0);
}

/// The width (or height) at which an image of `full` texels is stored so that a pixel averages at most two
/// stored texels: halved, rounding up, as often as needed.
int storedSize(int full, double averaged) {
  int size = full;
  while (size > 1 && averaged * size > 2.0 * full) size = (size + 1) / 2;
  return size;
}

/// A pattern along one axis, in stored texels, as Instance has it.
struct AxisMap {
  float start = 0.0F;
  float perPixel = 0.0F;
  float window = 1.0F;
};

/// `fromPattern`: px from the pattern's origin to the instance's; `size`: px of one copy; `count`: stored
/// texels.
AxisMap mapAxis(double fromPattern, double size, int count, double window, bool repeat) {
  if (count == 1) return {}; // the same everywhere, also where copies are smaller than a pixel
  double start = fromPattern / size * count;
  if (repeat) start = std::fmod(start, count); // near 0, where a float's fraction is fine
  if (!std::isfinite(start)) start = 0.0;      // beyond what a double can place
  return {static_cast<float>(start), static_cast<float>(count / size),
          static_cast<float>(std::max(window, 1.0))};
}

} // namespace

PatternTexture::PatternTexture(std::shared_ptr<GlDevice> device) : device_(std::move(device)) {}

PatternTexture::~PatternTexture() {
  device_->gl().deleteTextures(1, &texture_); // 0 is ignored
  device_->gl().deleteBuffers(1, &buffer_);
}

bool PatternTexture::place(const PlacedPattern& pattern, Instance& instance) {
  const Image& image = *pattern.image;
  const Vec2 reduction(image.width / pattern.size.x(), image.height / pattern.size.y());
  const bool fine = losesDetail(pattern.image, reduction.maxCoeff());
  const Vec2 averaged(averagedTexels(reduction.x(), fine), averagedTexels(reduction.y(), fine));
  const Level& texels =
      level(pattern.image, storedSize(image.width, averaged.x()), storedSize(image.height, averaged.y()));
  instance.texels = {texels.first, texels.width, texels.height, pattern.repeat ? 1 : 0};
  const std::array<AxisMap, 2> axes{
      mapAxis(instance.origin[0] - pattern.origin.x(), pattern.size.x(), texels.width,
              averaged.x() * texels.width / image.width, pattern.repeat),
      mapAxis(instance.origin[1] - pattern.origin.y(), pattern.size.y(), texels.height,
              averaged.y() * texels.height / image.height, pattern.repeat)};
  instance.texelMap = {axes[0].start, axes[1].start, axes[0].perPixel, axes[1].perPixel};
  instance.window = {axes[0].window, axes[1].window};
  return axes[0].window > 1.0F || axes[1].window > 1.0F;
}

bool PatternTexture::losesDetail(const std::shared_ptr<const Image>& image, double reduction) {
  if (!(reduction > 1.0)) return false;
  const auto [entry, isNew] = details_.try_emplace(image.get());
  if (isNew) {
    entry->second = imageDetail(*image);
    images_.emplace(image.get(), image);
  }
  const auto last = static_cast<double>(entry->second.size() - 1);
  const auto level = static_cast<std::size_t>(std::min(std::ceil(std::log2(reduction)), last));
  return entry->second[level] > kVisibleDetail;
}

void PatternTexture::bind() const {
  device_->gl().bindTexture(GL_TEXTURE_BUFFER, texture_);
}

const PatternTexture::Level& PatternTexture::level(const std::shared_ptr<const Image>& image, int width,
                                                   int height) {
  const Key key(image.get(), width, height);
  const auto found = levels_.find(key);
  if (found != levels_.end()) return found->second;

  images_.emplace(image.get(), image);
  const Level placed{append(areaReduce(*image, width, height)), width, height};
  return levels_.emplace(key, placed).first->second;
}

void PatternTexture::place(const std::shared_ptr<const Mask>& mask, Instance& instance) {
  auto found = masks_.find(mask.get());
  if (found == masks_.end()) {
    std::vector<std::uint8_t> rgba;
    rgba.reserve(mask->coverage.size() * kTexelBytes);
    for (const std::uint8_t coverage : mask->coverage) rgba.insert(rgba.end(), kTexelBytes, coverage);
    const int first = append(rgba);
    found = masks_.emplace(mask.get(), PlacedMask{mask, first}).first;
  }
  instance.texels = {found->second.first, mask->width, mask->height, 0};
}

int PatternTexture::append(const std::vector<std::uint8_t>& rgba) {
  const auto texels = static_cast<std::int64_t>(rgba.size() / kTexelBytes);
  if (used_ + texels > device_->maxTexels()) {
    throw Error(ExitCode::BadInput,
                fmt::format("the image patterns and texts hold {} texels together; {} can draw with at most "
                            "{}: use smaller images",
                            used_ + texels, device_->text(GL_RENDERER), device_->maxTexels()));
  }
  reserve(used_ + static_cast<int>(texels));
  const GlFunctions& gl = device_->gl();
  gl.bindBuffer(GL_TEXTURE_BUFFER, buffer_);
  gl.bufferSubData(GL_TEXTURE_BUFFER, static_cast<GLintptr>(used_) * kTexelBytes,
                   static_cast<GLsizeiptr>(rgba.size()), rgba.data());
  checkGl(gl, "uploading an image pattern");
  const int first = used_;
  used_ += static_cast<int>(texels);
  return first;
}

void PatternTexture::reserve(int texels) {
  if (texels <= capacity_) return;
  const std::int64_t doubled = std::max<std::int64_t>(2LL * capacity_, kFirstCapacity);
  const int capacity =
      static_cast<int>(std::min<std::int64_t>(std::max<std::int64_t>(doubled, texels), device_->maxTexels()));
  const GlFunctions& gl = device_->gl();
  GLuint grown = 0;
  gl.genBuffers(1, &grown);
  gl.bindBuffer(GL_COPY_WRITE_BUFFER, grown);
  gl.bufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(capacity) * kTexelBytes, nullptr,
                GL_STATIC_DRAW);
  if (used_ > 0) {
    gl.bindBuffer(GL_COPY_READ_BUFFER, buffer_);
    gl.copyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                         static_cast<GLsizeiptr>(used_) * kTexelBytes);
  }
  if (texture_ == 0) gl.genTextures(1, &texture_);
  gl.bindTexture(GL_TEXTURE_BUFFER, texture_);
  gl.texBuffer(GL_TEXTURE_BUFFER, GL_RGBA8, grown);
  gl.deleteBuffers(1, &buffer_); // 0 is ignored
  buffer_ = grown;
  capacity_ = capacity;
  checkGl(gl, "making room for image patterns");
}

} // namespace offstage
