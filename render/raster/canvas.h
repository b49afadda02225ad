#pragma once

#include "render/draw/picture.h"
#include "render/raster/frame.h"

#include <memory>
#include <string>

namespace offstage {

/// Draws pictures with OpenGL. Coverage is computed analytically in the fragment shader; sRGB values are
/// blended as they are. Used from one thread; a process that forks makes its canvas after the fork.
class Canvas {
public:
  /// Throws Error(Environment) without a usable GL; Error(BadInput) when the size is not 1 … maxSize() a
  /// side.
  Canvas(int width, int height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Draws the picture into `frame` (resized as needed). The picture's size must be the canvas's. Only what
  /// differs from the canvas's picture before is drawn again, and read when `frame` still holds that one; the
  /// pixels are those of a whole redraw, bit for bit. frame.base and frame.damage say what was drawn again.
  void draw(const Picture& picture, Frame& frame);

  /// Makes the next draw() a whole redraw.
  void forget();

  struct Info {
    std::string backend;  ///< "osmesa", "egl" or "egl-device"
    std::string renderer; ///< GL_RENDERER
    std::string version;  ///< GL_VERSION
    int maxSize = 0;      ///< px a side
  };
  [[nodiscard]] Info info() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace offstage
