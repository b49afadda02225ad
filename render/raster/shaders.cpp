#include "render/raster/shaders.h"

#include "src/sim/error.h"

#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

// What keeps the pixels the same on every processor: every value comes from gl_FragCoord or from flat
// attributes; only +, −, ×, one division, sqrt, min, max, floor and integer arithmetic are used, which
// llvmpipe computes as IEEE 754 does at any vector width; texels are fetched whole and filtered here.

constexpr const char* kVertex = R"(
layout(location = 0) in uvec4 quad;
layout(location = 1) in ivec2 origin;
layout(location = 2) in uvec4 color;
layout(location = 3) in vec4 outer;
layout(location = 4) in vec4 inner;
layout(location = 5) in ivec4 texels;
layout(location = 6) in vec4 texelMap;
layout(location = 7) in vec2 window;

uniform vec2 clipPerPixel; // 2/size

flat out vec4 vOuter;
#ifdef HAS_INNER
flat out vec4 vInner;
#endif
flat out vec2 vOrigin;
#ifdef PATTERN
flat out vec3 vWindowAlpha;
flat out ivec4 vTexels;
flat out vec4 vTexelMap;
#else
flat out vec4 vColor; // premultiplied
#endif

void main() {
  // Corner 0…3 of a triangle strip. Row 0 of the framebuffer is the frame's top row, so y is not turned over.
  vec2 corner = vec2((gl_VertexID & 1) == 0 ? quad.x : quad.z, (gl_VertexID & 2) == 0 ? quad.y : quad.w);
  gl_Position = vec4(corner * clipPerPixel - 1.0, 0.0, 1.0);
  vOuter = outer;
#ifdef HAS_INNER
  vInner = inner;
#endif
  vOrigin = vec2(origin);
  float alpha = float(color.a) * (1.0 / 255.0);
#ifdef PATTERN
  vWindowAlpha = vec3(window, alpha);
  vTexels = texels;
  vTexelMap = texelMap;
#else
  vColor = vec4(vec3(color.rgb) * (1.0 / 255.0) * alpha, alpha);
#endif
}
)";

/// The part of the pixel with centre p (from the origin) that lies in a circle given as Instance::outer.
///
/// n = (p − centre)/r; by symmetry n.x, n.y ≥ 0. v is the axis that n is nearer to, u the other one. From the
/// pixel's centre along v, the edge is at the root of v²/(2r) + n_v v + g = 0: e = −2g/(n_v + w), with
/// w² = n_v² − 2g/r = 1 − n_u²; there its slope is −n_u/w and its curvature −(1 + slope²)/(r w). The area
/// below that parabola is summed over eight columns, the height in each cut to the pixel's. |slope| ≤ 1 up to
/// the pixel's size against r, which keeps the error of a column that the edge leaves the pixel in below
/// 1/128 of it. The bound on w matters only where the pixel is wholly outside.
constexpr const char* kParabola = R"(
float insideParabola(vec2 p, vec4 edge) {
  vec2 n = edge.xy + p * edge.z;
  vec2 gradient = edge.xy + p * (0.5 * edge.z);
  float g = edge.w + (p.x * gradient.x + p.y * gradient.y);
  n = abs(n);
  float nv = max(n.x, n.y);
  float nu = min(n.x, n.y);
  float w = sqrt(max(1.0 - nu * nu, 0.25));
  float inverse = 1.0 / (w * (nv + w));
  float height = 0.5 - 2.0 * g * w * inverse;
  float slope = nu * ((nv + w) * inverse);
  float bend = (-0.5 * edge.z) * (1.0 + slope * slope) * ((nv + w) * inverse);
  vec4 u = vec4(0.0625, 0.1875, 0.3125, 0.4375);
  vec4 mean = height + bend * (u * u);
  vec4 tilt = slope * u;
  vec4 columns = clamp(mean + tilt, 0.0, 1.0) + clamp(mean - tilt, 0.0, 1.0);
  return ((columns.x + columns.y) + (columns.z + columns.w)) * 0.125;
}
)";

/// The same for any radius below kParabolaRadius: sixteen columns over the part of the pixel that the circle
/// spans, each cut by both its upper and its lower edge.
constexpr const char* kSmall = R"(
float insideSmall(vec2 p, vec4 edge) {
  float r = 1.0 / edge.z;
  vec2 q = abs(edge.xy + p * edge.z) * r;
  float qv = max(q.x, q.y);
  float qu = min(q.x, q.y);
  float low = max(qu - 0.5, -r);
  float step = max(min(qu + 0.5, r) - low, 0.0) * 0.0625;
  float sum = 0.0;
  for (int i = 0; i < 16; ++i) {
    float u = low + (float(i) + 0.5) * step;
    float y = sqrt(max(r * r - u * u, 0.0));
    sum += max(min(y, qv + 0.5) + min(y, 0.5 - qv), 0.0);
  }
  return sum * step;
}

float insideAny(vec2 p, vec4 edge) {
  if (edge.z <= 0.0) return 0.0; // no such edge
  if (edge.z > SMALL_CURVATURE) return insideSmall(p, edge);
  return insideParabola(p, edge);
}
)";

/// The overlap of the pixel with a rectangle: along each axis the integral over the pixel of [t > low] − [t >
/// high].
constexpr const char* kBox = R"(
float insideBox(vec2 p, vec4 edges) {
  vec2 overlap = clamp(p + 0.5 - edges.xy, 0.0, 1.0) - clamp(p + 0.5 - edges.zw, 0.0, 1.0);
  return overlap.x * overlap.y;
}
)";

/// The pattern's colour, premultiplied: the mean of the image, each texel a rectangle of its colour, over the
/// window (1 to 2 texels an axis) around the pixel's centre. A window of one texel is bilinear interpolation.
/// TAPS texels an axis are enough: 2 for windows of one texel, else 3.
constexpr const char* kPattern = R"(
uniform samplerBuffer store;

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

constexpr const char* kFragmentInputs = R"(
flat in vec4 vOuter;
#ifdef HAS_INNER
flat in vec4 vInner;
#endif
flat in vec2 vOrigin;
#ifdef PATTERN
flat in vec3 vWindowAlpha;
flat in ivec4 vTexels;
flat in vec4 vTexelMap;
#else
flat in vec4 vColor;
#endif
out vec4 result;
)";

const char* coverageBody(Coverage coverage) {
  switch (coverage) {
  case Coverage::Disc:
    return "insideParabola(p, vOuter)";
  case Coverage::Ring:
    return "insideParabola(p, vOuter) - insideParabola(p, vInner)";
  case Coverage::Small:
    return "insideAny(p, vOuter) - insideAny(p, vInner)";
  case Coverage::Box:
    return "insideBox(p, vOuter) - insideBox(p, vInner)";
  }
  return "";
}

std::string defines(Coverage coverage, PaintSource paint) {
  std::string text = "#version 330 core\n";
  if (coverage != Coverage::Disc) text += "#define HAS_INNER\n";
  if (paint != PaintSource::Color) text += "#define PATTERN\n";
  text += fmt::format("#define TAPS {}\n", paint == PaintSource::Reduced ? 3 : 2);
  text += fmt::format("#define SMALL_CURVATURE {:.9f}\n", 1.0 / kParabolaRadius);
  return text;
}

std::string fragmentSource(Coverage coverage, PaintSource paint) {
  std::string text = defines(coverage, paint) + kFragmentInputs;
  if (coverage == Coverage::Box) {
    text += kBox;
  } else {
    text += kParabola;
    if (coverage == Coverage::Small) text += kSmall;
  }
  if (paint != PaintSource::Color) text += kPattern;
  text += fmt::format("void main() {{\n"
                      "  vec2 p = gl_FragCoord.xy - vOrigin;\n"
                      "  float covered = {};\n"
                      "  result = {} * covered;\n"
                      "}}\n",
                      coverageBody(coverage), paint == PaintSource::Color ? "vColor" : "pattern(p)");
  return text;
}

GLuint compile(const GlFunctions& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.createShader(stage);
  const char* text = source.c_str();
  gl.shaderSource(shader, 1, &text, nullptr);
  gl.compileShader(shader);
  GLint compiled = GL_FALSE;
  gl.getShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::array<char, 2048> log{};
  gl.getShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  gl.deleteShader(shader);
  throw Error(ExitCode::Environment, fmt::format("OpenGL does not compile a shader: {}", log.data()));
}

} // namespace

Shaders::Shaders(const GlFunctions& gl, int width, int height) : gl_(gl), width_(width), height_(height) {}

Shaders::~Shaders() {
  for (const GLuint program : programs_) gl_.deleteProgram(program); // 0 is ignored
}

void Shaders::use(Coverage coverage, PaintSource paint) {
  GLuint& program =
      programs_.at(static_cast<std::size_t>(coverage) * kPaintSourceCount + static_cast<std::size_t>(paint));
  if (program == 0) program = build(coverage, paint);
  gl_.useProgram(program);
}

GLuint Shaders::build(Coverage coverage, PaintSource paint) {
  const GLuint vertex = compile(gl_, GL_VERTEX_SHADER, defines(coverage, paint) + kVertex);
  GLuint fragment = 0;
  try {
    fragment = compile(gl_, GL_FRAGMENT_SHADER, fragmentSource(coverage, paint));
  } catch (...) {
    gl_.deleteShader(vertex);
    throw;
  }
  const GLuint program = gl_.createProgram();
  gl_.attachShader(program, vertex);
  gl_.attachShader(program, fragment);
  gl_.linkProgram(program);
  gl_.deleteShader(vertex); // kept by the program
  gl_.deleteShader(fragment);
  GLint linked = GL_FALSE;
  gl_.getProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    std::array<char, 2048> log{};
    gl_.getProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl_.deleteProgram(program);
    throw Error(ExitCode::Environment, fmt::format("OpenGL does not link a program: {}", log.data()));
  }
  gl_.useProgram(program);
  gl_.uniform2f(gl_.getUniformLocation(program, "clipPerPixel"), 2.0F / static_cast<float>(width_),
                2.0F / static_cast<float>(height_));
  return program;
}

} // namespace offstage
