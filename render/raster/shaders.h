#pragma once

#include "render/raster/gl_functions.h"
#include "render/raster/instance.h"

#include <array>
#include <memory>

namespace offstage {

/// Where a pixel's colour comes from.
enum class PaintSource : std::uint8_t {
  Color,   ///< Instance::color
  Pattern, ///< an image, interpolated between 2×2 texels
  Reduced, ///< an image drawn much smaller, averaged over up to 3×3 texels
};
inline constexpr std::size_t kPaintSourceCount = 3;

/// The canvas's programs. Each is compiled when it is first used, because a scene uses few of them and each
/// costs milliseconds.
class Shaders {
public:
  /// width, height: of the framebuffer in px.
  Shaders(const GlFunctions& gl, int width, int height);
  ~Shaders();
  Shaders(const Shaders&) = delete;
  Shaders& operator=(const Shaders&) = delete;

  /// Makes the program current. Throws Error(Environment) with the driver's log when it does not compile.
  void use(Coverage coverage, PaintSource paint);

private:
  GLuint build(Coverage coverage, PaintSource paint);

  const GlFunctions& gl_;
  int width_;
  int height_;
  std::array<GLuint, kCoverageCount * kPaintSourceCount> programs_{}; ///< 0: not yet built
};

} // namespace offstage
