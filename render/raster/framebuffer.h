#pragma once

#include "render/draw/picture.h"
#include "render/raster/frame.h"
#include "render/raster/gl_functions.h"

#include <span>

namespace offstage {

/// The RGBA8 framebuffer that a canvas draws into, colours premultiplied. Row 0 is the frame's top row.
class Framebuffer {
public:
  /// Throws Error(Transient) when there is no memory for it.
  Framebuffer(const GlFunctions& gl, int width, int height);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  void bind() const;
  void clear(Rgba8 color) const;
  /// The pixels of `rect` as they are stored: 4 bytes each, premultiplied, rows `stride` px apart.
  void readStored(const PixelRect& rect, std::uint8_t* rgba, int stride) const;
  [[nodiscard]] bool fits(const Frame& frame) const; ///< its size is this one's
  /// All pixels, colours not premultiplied. `opaque`: every alpha is 255, nothing needs to be divided.
  void read(Frame& frame, bool opaque) const;
  /// The pixels of `rect`, into a frame that fits; the others stay as they are.
  void read(Frame& frame, const PixelRect& rect, bool opaque) const;

private:
  const GlFunctions& gl_;
  int width_;
  int height_;
  GLuint color_ = 0;
  GLuint framebuffer_ = 0;
};

/// Multiplies the colour by its alpha, rounding to nearest.
Rgba8 premultiplied(Rgba8 color);

/// Divides colours by their alpha, rounding to nearest: opaque pixels stay as they are, wholly transparent
/// ones become 0. `rgba` holds 4 bytes a pixel.
void unpremultiply(std::span<std::uint8_t> rgba);

} // namespace offstage
