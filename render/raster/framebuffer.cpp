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
  const float alpha = static_cast<float>(color.a) / 255.0F;
  const auto premultiplied = [&](std::uint8_t value) { return static_cast<float>(value) / 255.0F * alpha; };
  gl_.clearColor(premultiplied(color.r), premultiplied(color.g), premultiplied(color.b), alpha);
  gl_.clear(GL_COLOR_BUFFER_BIT);
}

void Framebuffer::read(Frame& frame, bool opaque) const {
  frame.width = width_;
  frame.height = height_;
  frame.rgba.resize(4UL * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  gl_.pixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.readPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, frame.rgba.data());
  if (!opaque) unpremultiply(frame.rgba);
}

void unpremultiply(std::vector<std::uint8_t>& rgba) {
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
