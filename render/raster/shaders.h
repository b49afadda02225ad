#pragma once

#include "render/raster/gl_functions.h"
#include "render/raster/shader_sources.h"

#include <array>

namespace offstage {

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
  void use(const ProgramKind& kind);

private:
  [[nodiscard]] GLuint build(const ProgramKind& kind) const;

  const GlFunctions& gl_;
  int width_;
  int height_;
  std::array<GLuint, kCoverageCount * kPaintSourceCount * kFootprintCount> programs_{}; ///< 0: not yet built
};

} // namespace offstage
