#include "render/raster/shader_sources.h"

#include "render/raster/shader_paths.h"

#include <fmt/format.h>

namespace offstage {
namespace {

// What keeps the pixels the same on every processor: every value comes from gl_FragCoord or from flat
// attributes; only +, −, ×, division, sqrt, abs, min, max, floor and integer arithmetic are used, which
// llvmpipe computes alike at any vector width; texels are fetched whole and filtered here.

constexpr const char* kVertex = R"(
layout(location = 0) in uvec4 quad;
layout(location = 1) in ivec2 origin;
layout(location = 2) in uvec4 color;
layout(location = 3) in vec4 outer;
layout(location = 4) in vec4 inner;
layout(location = 5) in ivec4 texels;
layout(location = 6) in vec4 texelMap;
layout(location = 7) in vec2 window;

uniform vec2 clipPerPixel;

#ifndef WHOLE
flat out vec4 vOuter;
#endif
#ifdef HAS_ORIGIN
flat out vec2 vOrigin;
#endif
#ifdef HAS_INNER
flat out vec4 vInner;
#endif
#ifdef HAS_MORE
flat out vec4 vMore;
flat out vec2 vRest;
#endif
#ifdef HAS_TEXELS
flat out ivec4 vTexels;
#endif
#ifdef PATTERN
flat out vec3 vWindowAlpha;
flat out vec4 vTexelMap;
#else
flat out vec4 vColor; // premultiplied
#endif

void main() {
  // Row 0 of the framebuffer is the frame's top row, so y is not turned over.
#ifdef POINT
  float side = float(quad.z - quad.x);
  gl_PointSize = side;
  // An instance that only fills up a vector has no side and goes outside.
  gl_Position = side > 0.0 ? vec4((vec2(quad.xy) + 0.5 * side) * clipPerPixel - 1.0, 0.0, 1.0)
                           : vec4(2.0, 2.0, 0.0, 1.0);
#else
  int id = min(gl_VertexID, 3); // corners of a triangle strip; further vertices repeat the last
  vec2 corner = vec2((id & 1) == 0 ? quad.x : quad.z, (id & 2) == 0 ? quad.y : quad.w);
  gl_Position = vec4(corner * clipPerPixel - 1.0, 0.0, 1.0);
#endif
#ifndef WHOLE
  vOuter = outer;
#endif
#ifdef HAS_ORIGIN
  vOrigin = vec2(origin);
#endif
#ifdef HAS_INNER
  vInner = inner;
#endif
#ifdef HAS_MORE
  vMore = texelMap;
  vRest = window;
#endif
  float alpha = float(color.a) * (1.0 / 255.0);
#ifdef HAS_TEXELS
  vTexels = texels;
#endif
#ifdef PATTERN
  vWindowAlpha = vec3(window, alpha);
  vTexelMap = texelMap;
#else
#ifdef WHOLE
  vColor = vec4(color) / 255.0; // stored as it is
#else
  vColor = vec4(vec3(color.rgb) * (1.0 / 255.0) * alpha, alpha);
#endif
#endif
}
)";

constexpr const char* kFragmentInputs = R"(
#ifndef WHOLE
flat in vec4 vOuter;
#endif
#ifdef HAS_ORIGIN
flat in vec2 vOrigin;
#endif
#ifdef HAS_INNER
flat in vec4 vInner;
#endif
#ifdef HAS_MORE
flat in vec4 vMore;
flat in vec2 vRest;
#endif
#ifdef HAS_TEXELS
flat in ivec4 vTexels;
uniform samplerBuffer store;
#endif
#ifdef PATTERN
flat in vec3 vWindowAlpha;
flat in vec4 vTexelMap;
#else
flat in vec4 vColor;
#endif
out vec4 result;

#ifdef HAS_ORIGIN
vec2 fromOrigin() { return gl_FragCoord.xy - vOrigin; }
#endif
)";

/// max() and min() of two numbers of which one at least is not negative: the bits of floats then order as
/// integers do. llvmpipe's own take three instructions, to return the other number for a NaN, which took a
/// tenth of the time of a frame of 10,000 discs. With a constant as the second operand they take one, too.
constexpr const char* kOrder = R"(
float larger(float a, float b) { return intBitsToFloat(max(floatBitsToInt(a), floatBitsToInt(b))); }
float smaller(float a, float b) { return intBitsToFloat(min(floatBitsToInt(a), floatBitsToInt(b))); }
)";

/// The area of the pixel under a parabola, given by its height above the pixel's lower side at the middle,
/// its slope there (0 to about 1; the sign does not matter) and half its second derivative. Summed over four
/// columns, the height in each cut to the pixel's: where the parabola leaves the pixel inside a column, the
/// column is wrong by at most slope/8 of its own area.
constexpr const char* kColumns = R"(
float underParabola(float height, float slope, float bend) {
  vec2 u = vec2(0.125, 0.375);
  vec2 mean = height + bend * (u * u);
  vec2 tilt = slope * u;
  vec2 columns = clamp(mean + tilt, 0.0, 1.0) + clamp(mean - tilt, 0.0, 1.0);
  return (columns.x + columns.y) * 0.25;
}
)";

/// The part of the pixel with centre p (from the frame's corner) that lies in a circle of kLeastArcRadius to
/// kMostArcRadius. By symmetry the pixel lies in one octant: v is its coordinate from the circle's centre
/// along the axis where that is larger, u the other. The edge is at v = w = sqrt(r² − u²), its slope there
/// −u/w and its second derivative −r²/w³ = −(1 + slope²)/w. The bound on w matters only where the pixel is
/// wholly outside.
constexpr const char* kArc = R"(
float insideArc(vec2 p, vec4 edge) {
  vec2 from = abs(p - edge.xy);
  float v = larger(from.x, from.y);
  float u = smaller(from.x, from.y);
  float w = sqrt(larger(edge.z - u * u, 0.25 * edge.z));
  float inverse = 1.0 / w;
  float slope = u * inverse;
  return underParabola(w - v + 0.5, slope, (slope * slope + 1.0) * (-0.5 * inverse));
}
)";

/// The same for any radius of kLeastArcRadius or more, as Instance has it: n = (p − centre)/r, its components
/// as above. From the pixel's centre along v, the edge is at the root of v²/(2r) + n_v v + g = 0, which is
/// −2g/(n_v + w) with w² = n_v² − 2g/r = 1 − n_u²; its slope there is −n_u/w and its second derivative −(1 +
/// slope²)/(r w).
constexpr const char* kLarge = R"(
float insideLarge(vec2 p, vec4 edge) {
  if (edge.z <= 0.0) return 0.0; // no such edge
  vec2 n = abs(edge.xy + p * edge.z);
  vec2 gradient = edge.xy + p * (0.5 * edge.z);
  float g = edge.w + (p.x * gradient.x + p.y * gradient.y);
  float nv = larger(n.x, n.y);
  float nu = smaller(n.x, n.y);
  float w = sqrt(max(1.0 - nu * nu, 0.25));
  float inverse = 1.0 / w;
  float slope = nu * inverse;
  return underParabola(0.5 - 2.0 * g / (nv + w), slope, (slope * slope + 1.0) * (-0.5 * edge.z * inverse));
}
)";

/// The same for any radius. Below kLeastArcRadius: sixteen columns over the part of the pixel that the circle
/// spans, each cut by both its upper and its lower edge.
constexpr const char* kSmall = R"(
float insideSmall(vec2 p, vec4 edge) {
  float r = 1.0 / edge.z;
  vec2 from = abs(edge.xy + p * edge.z) * r;
  float v = larger(from.x, from.y);
  float u = smaller(from.x, from.y);
  float low = -smaller(0.5 - u, r);
  float step = max(smaller(u + 0.5, r) - low, 0.0) * 0.0625;
  float sum = 0.0;
  for (int i = 0; i < 16; ++i) {
    float at = low + (float(i) + 0.5) * step;
    float w = sqrt(max(r * r - at * at, 0.0));
    sum += max(smaller(w, v + 0.5) + smaller(w, 0.5 - v), 0.0);
  }
  return sum * step;
}

float insideAny(vec2 p, vec4 edge) {
  return edge.z > SMALL_CURVATURE ? insideSmall(p, edge) : insideLarge(p, edge);
}
)";

/// The overlap of the pixel with a rectangle: along each axis the integral over the pixel of
/// [t > low] − [t > high].
constexpr const char* kBox = R"(
float insideBox(vec2 p, vec4 edges) {
  vec2 overlap = clamp(p + 0.5 - edges.xy, 0.0, 1.0) - clamp(p + 0.5 - edges.zw, 0.0, 1.0);
  return overlap.x * overlap.y;
}
)";

/// A pixel of a mask is a texel; beyond the mask, where a whole tile is drawn, there is nothing. p, from the
/// mask's corner, is the middle of a pixel, so its floor is sure.
constexpr const char* kMask = R"(
float insideMask(vec2 p) {
  ivec2 at = ivec2(floor(p));
  bool inside = at.x >= 0 && at.y >= 0 && at.x < vTexels.y && at.y < vTexels.z;
  return inside ? texelFetch(store, vTexels.x + at.y * vTexels.y + at.x).a : 0.0;
}
)";

/// The pattern's colour, premultiplied: the mean of the image, each texel a rectangle of its colour, over the
/// window (1 to 2 texels an axis) around the pixel's centre. A window of one texel is bilinear interpolation.
/// TAPS texels an axis are enough: 2 for windows of one texel, else 3.
constexpr const char* kPattern = R"(
vec4 texel(int x, int y) { return texelFetch(store, vTexels.x + y * vTexels.y + x); }

int place(int i, int count) {
  if (vTexels.w == 0) return clamp(i, 0, count - 1);
  // Euclidean remainder. The quotient of integers below 2^22 rounds to the right side of a whole number because
  // half a texel is added.
  int wraps = int(floor((float(i) + 0.5) / float(count)));
  return i - wraps * count;
}

vec4 pattern(vec2 p) {
  vec2 at = vTexelMap.xy + p * vTexelMap.zw;
  vec2 window = vWindowAlpha.xy;
  vec2 low = at - 0.5 * window;
  vec2 first = floor(low);
  vec2 start = low - first; // 0 … 1 into the first texel
  vec2 end = start + window;
  vec2 share = 1.0 / window;
  vec2 weights[TAPS];
  for (int i = 0; i < TAPS; ++i) {
    weights[i] = max(min(end, float(i) + 1.0) - max(start, float(i)), 0.0) * share;
  }
  ivec2 base = ivec2(first);
  vec4 sum = vec4(0.0);
  for (int j = 0; j < TAPS; ++j) {
    int y = place(base.y + j, vTexels.z);
    vec4 row = vec4(0.0);
    for (int i = 0; i < TAPS; ++i) row += texel(place(base.x + i, vTexels.y), y) * weights[i].x;
    sum += row * weights[j].y;
  }
  return sum * vWindowAlpha.z;
}
)";

/// Lays a premultiplied colour over an opaque ground in whole bytes as llvmpipe's blending does: the source
/// rounded to bytes, halves to even; what ground_check.cpp's keptOf() says of the ground, which `ground`
/// (groundOf()) times (255 − alpha) rounds to; the sum. GroundCheck finds out whether the driver at hand
/// blends so.
constexpr const char* kOnGround = R"(
vec4 onGround(vec4 color, float covered, vec3 ground) {
  precise vec4 premultiplied = color * covered; // rounded as where it is blended, not merged with the 255
  precise vec4 scaled = premultiplied * 255.0;
  // From 2^23 on floats are whole numbers. roundEven() takes halves up where llvmpipe has no instruction for it.
  precise vec4 lifted = scaled + 8388608.0;
  precise float clear = 8388863.0 - lifted.a; // 255 − a
  precise vec3 kept = ground * clear;
  precise vec3 sum = kept + lifted.rgb;
  precise vec3 bytes = sum - 8388608.0;
  return vec4(bytes * (1.0 / 255.0), 1.0);
}
)";

std::string coverageFunctions(Coverage coverage) {
  const std::string columns = kColumns;
  switch (coverage) {
  case Coverage::Disc:
  case Coverage::DiscOnGround:
  case Coverage::Ring:
    return columns + kArc;
  case Coverage::LargeCircle:
    return columns + kLarge;
  case Coverage::AnyCircle:
    return columns + kLarge + kSmall;
  case Coverage::Box:
    return kBox;
  case Coverage::Quad:
  case Coverage::Arrow:
  case Coverage::Strip:
  case Coverage::Elbow:
    return pathFunctions(coverage);
  case Coverage::Mask:
    return kMask;
  case Coverage::Whole:
    break;
  }
  return {};
}

const char* coverageExpression(Coverage coverage) {
  switch (coverage) {
  case Coverage::Disc:
  case Coverage::DiscOnGround:
    return "insideArc(gl_FragCoord.xy, vOuter)";
  case Coverage::Ring:
    return "insideArc(gl_FragCoord.xy, vOuter) - insideArc(gl_FragCoord.xy, vInner)";
  case Coverage::LargeCircle:
    return "insideLarge(fromOrigin(), vOuter) - insideLarge(fromOrigin(), vInner)";
  case Coverage::AnyCircle:
    return "insideAny(fromOrigin(), vOuter) - insideAny(fromOrigin(), vInner)";
  case Coverage::Box:
    return "insideBox(fromOrigin(), vOuter) - insideBox(fromOrigin(), vInner)";
  case Coverage::Quad:
  case Coverage::Arrow:
  case Coverage::Strip:
  case Coverage::Elbow:
    return pathExpression(coverage);
  case Coverage::Mask:
    return "insideMask(fromOrigin())";
  case Coverage::Whole:
    break;
  }
  return "";
}

const char* resultExpression(const ProgramKind& kind) {
  if (kind.coverage == Coverage::DiscOnGround) return "onGround(vColor, covered, vInner.rgb)";
  return kind.paint == PaintSource::Color ? "vColor * covered" : "pattern(fromOrigin()) * covered";
}

std::string preamble(const ProgramKind& kind) {
  std::string text = "#version 330 core\n"
                     "#extension GL_ARB_gpu_shader5 : enable\n" // precise
                     "#ifndef GL_ARB_gpu_shader5\n"
                     "#define precise\n"
                     "#endif\n";
  if (kind.coverage == Coverage::Whole) text += "#define WHOLE\n";
  const Coverage coverage = kind.coverage;
  const bool absolute = coverage == Coverage::Disc || coverage == Coverage::DiscOnGround ||
                        coverage == Coverage::Ring || coverage == Coverage::Strip ||
                        coverage == Coverage::Whole;
  if (kind.paint != PaintSource::Color || !absolute) text += "#define HAS_ORIGIN\n";
  const bool mask = coverage == Coverage::Mask;
  if (coverage != Coverage::Disc && coverage != Coverage::Strip && coverage != Coverage::Whole && !mask)
    text += "#define HAS_INNER\n";
  if (coverage == Coverage::Arrow || coverage == Coverage::Strip || coverage == Coverage::Elbow)
    text += "#define HAS_MORE\n";
  if (kind.paint != PaintSource::Color) text += "#define PATTERN\n";
  if (kind.paint != PaintSource::Color || mask) text += "#define HAS_TEXELS\n";
  if (kind.footprint == Footprint::Point) text += "#define POINT\n";
  text += fmt::format("#define TAPS {}\n", kind.paint == PaintSource::Reduced ? 3 : 2);
  text += fmt::format("#define SMALL_CURVATURE {:.9f}\n", 1.0 / kLeastArcRadius);
  return text;
}

} // namespace

std::string vertexSource(const ProgramKind& kind) {
  return preamble(kind) + kVertex;
}

std::string fragmentSource(const ProgramKind& kind) {
  std::string text = preamble(kind) + kFragmentInputs + kOrder;
  text += coverageFunctions(kind.coverage);
  if (kind.coverage == Coverage::DiscOnGround) text += kOnGround;
  if (kind.paint != PaintSource::Color) text += kPattern;
  if (kind.coverage == Coverage::Whole) return text + "void main() { result = vColor; }\n";
  text += fmt::format("void main() {{\n"
                      "  float covered = {};\n"
                      "  result = {};\n"
                      "}}\n",
                      coverageExpression(kind.coverage), resultExpression(kind));
  return text;
}

} // namespace offstage
