#include "render/raster/framebuffer.h"

#include "src/sim/error.h"

#include <algorithm>

#include <fmt/format.h>

namespace offstage {

Framebuffer::Framebuffer(const GlFunctions& gl, int width, int height)
    : gl_(gl), width_(width), height_(height) {
  gl_.genRenderbuffers(1, &color_);
  gl_.genFramebuffers(1, &framebuffer_);
  gl_.bindRenderbuffer(GL_RENDERBUFFER, color_);
  gl_.renderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  gl_.bindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.framebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
  const bool complete = gl_.checkFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (gl_.getError() != GL_NO_ERROR || !complete) {
    gl_.deleteFramebuffers(1, &framebuffer_);
    gl_.deleteRenderbuffers(1, &color_);
    throw Error(ExitCode::Transient,
                fmt::format("OpenGL has no memory for a framebuffer of {}x{} px", width, height));
  }
}

Framebuffer::~Framebuffer() {
  gl_.deleteFramebuffers(1, &framebuffer_);
  gl_.deleteRenderbuffers(1, &color_);
}

void Framebuffer::bind() const {
  gl_.bindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.viewport(0, 0, width_, height_);
}

void Framebuffer::clear(Rgba8 color) const {
  const Rgba8 stored = premultiplied(color); // whole bytes, so that every driver stores the same
  const auto part = [](std::uint8_t value) { return static_cast<float>(value) / 255.0F; };
  gl_.clearColor(part(stored.r), part(stored.g), part(stored.b), part(stored.a));
  gl_.clear(GL_COLOR_BUFFER_BIT);
}

void Framebuffer::readStored(const PixelRect& rect, std::uint8_t* rgba, int stride) const {
  gl_.pixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.pixelStorei(GL_PACK_ROW_LENGTH, stride);
  gl_.readPixels(rect.left, rect.top, rect.right - rect.left, rect.bottom - rect.top, GL_RGBA,
                 GL_UNSIGNED_BYTE, rgba);
}

bool Framebuffer::fits(const Frame& frame) const {
  return frame.width == width_ && frame.height == height_ &&
         frame.rgba.size() == 4UL * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

void Framebuffer::read(Frame& frame, bool opaque) const {
  frame.width = width_;
  frame.height = height_;
  frame.rgba.resize(4UL * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  read(frame, {0, 0, width_, height_}, opaque);
}

void Framebuffer::read(Frame& frame, const PixelRect& rect, bool opaque) const {
  const auto stride = 4UL * static_cast<std::size_t>(width_);
  const auto length = 4UL * static_cast<std::size_t>(rect.right - rect.left);
  std::uint8_t* first = frame.rgba.data() + static_cast<std::size_t>(rect.top) * stride +
                        4UL * static_cast<std::size_t>(rect.left);
  readStored(rect, first, width_);
  if (opaque) return;
  for (int y = rect.top; y < rect.bottom; ++y, first += stride) unpremultiply({first, length});
}

Rgba8 premultiplied(Rgba8 color) {
  const auto part = [&](unsigned value) {
    return static_cast<std::uint8_t>((value * color.a + 127U) / 255U);
  };
  return {part(color.r), part(color.g), part(color.b), color.a};
}

void unpremultiply(std::span<std::uint8_t> rgba) {
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
    const unsigned alpha = rgba[i + 3];
    if (alpha == 255) continue;
    for (std::size_t channel = i; channel < i + 3; ++channel) {
      const unsigned value = alpha == 0 ? 0U : (rgba[channel] * 255U + alpha / 2U) / alpha;
      rgba[channel] = static_cast<std::uint8_t>(std::min(value, 255U));
    }
  }
}

} // namespace offstage
