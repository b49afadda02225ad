#include "render/raster/pattern_texture.h"

#include "render/raster/area_reduce.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr int kTexelBytes = 4;
constexpr int kFirstCapacity = 1 << 16; // texels: 256 KiB

/// The width (or height) at which an image of `full` texels is stored to be drawn `drawn` px wide: halved,
/// rounding up, until at most two texels fall to a pixel.
int storedSize(int full, double drawn) {
  int size = full;
  while (size > 1 && size > 2.0 * drawn) size = (size + 1) / 2;
  return size;
}

} // namespace

PatternTexture::PatternTexture(std::shared_ptr<GlDevice> device) : device_(std::move(device)) {}

PatternTexture::~PatternTexture() {
  device_->gl().deleteTextures(1, &texture_); // 0 is ignored
  device_->gl().deleteBuffers(1, &buffer_);
}

bool PatternTexture::place(const PlacedPattern& pattern, Instance& instance) {
  const Level& texels = level(pattern.image, storedSize(pattern.image->width, pattern.size.x()),
                              storedSize(pattern.image->height, pattern.size.y()));
  instance.texels = {texels.first, texels.width, texels.height, pattern.repeat ? 1 : 0};
  const auto axis = [&](int i, int count) {
    const double perPixel = count / pattern.size[i];
    double start = (instance.origin[static_cast<std::size_t>(i)] - pattern.origin[i]) * perPixel;
    if (pattern.repeat) start -= count * std::floor(start / count); // keeps the float's fraction fine
    instance.texelMap[static_cast<std::size_t>(i)] = static_cast<float>(start);
    instance.texelMap[static_cast<std::size_t>(i) + 2] = static_cast<float>(perPixel);
    return perPixel > 1.0;
  };
  const bool reducedX = axis(0, texels.width);
  const bool reducedY = axis(1, texels.height);
  return reducedX || reducedY;
}

void PatternTexture::bind() const {
  device_->gl().bindTexture(GL_TEXTURE_BUFFER, texture_);
}

const PatternTexture::Level& PatternTexture::level(const std::shared_ptr<const Image>& image, int width,
                                                   int height) {
  const Key key(image.get(), width, height);
  const auto found = levels_.find(key);
  if (found != levels_.end()) return found->second;

  const std::int64_t texels = static_cast<std::int64_t>(width) * height;
  if (used_ + texels > device_->maxTexels()) {
    throw Error(ExitCode::BadInput,
                fmt::format("the image patterns hold {} texels together; {} can draw with at most {}: use "
                            "smaller images",
                            used_ + texels, device_->text(GL_RENDERER), device_->maxTexels()));
  }
  const std::vector<std::uint8_t> rgba = areaReduce(*image, width, height);
  reserve(used_ + static_cast<int>(texels));
  const GlFunctions& gl = device_->gl();
  gl.bindBuffer(GL_TEXTURE_BUFFER, buffer_);
  gl.bufferSubData(GL_TEXTURE_BUFFER, static_cast<GLintptr>(used_) * kTexelBytes,
                   static_cast<GLsizeiptr>(rgba.size()), rgba.data());
  checkGl(gl, "uploading an image pattern");
  images_.emplace(image.get(), image);
  const Level placed{used_, width, height};
  used_ += static_cast<int>(texels);
  return levels_.emplace(key, placed).first->second;
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
