#pragma once

#include "render/raster/instance.h"

#include <string>

namespace offstage {

/// Where a pixel's colour comes from.
enum class PaintSource : std::uint8_t {
  Color,   ///< Instance::color
  Pattern, ///< an image, interpolated between 2×2 texels
  Reduced, ///< an image drawn much smaller, averaged over up to 3×3 texels
};
inline constexpr std::size_t kPaintSourceCount = 3;

/// One of the canvas's programs.
struct ProgramKind {
  Coverage coverage;
  PaintSource paint;
  Footprint footprint;
  friend bool operator==(const ProgramKind&, const ProgramKind&) = default;
};

/// True for programs whose result replaces what was there; those of the others are blended over it.
constexpr bool replaces(Coverage coverage) {
  return coverage == Coverage::Whole || coverage == Coverage::DiscOnGround;
}

/// GLSL 3.30. Vertex attributes 0 … kAttributeCount − 1 are Instance's members in their order; the uniform
/// `clipPerPixel` is 2/size; the fragment shader's `store` is the buffer texture of patterns in unit 0. The
/// result is premultiplied.
std::string vertexSource(const ProgramKind& kind);
std::string fragmentSource(const ProgramKind& kind);

} // namespace offstage
