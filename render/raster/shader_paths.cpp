#include "render/raster/shader_paths.h"

namespace offstage {
namespace {

/// The mean of clamp(t, 0, 1) while t goes evenly from a to b. Of [a, b] the part inside 0 … 1 counts with
/// its own middle, the part above with 1; written so that a span that lies wholly above gives exactly 1.
constexpr const char* kMeanClamp = R"(
float meanClamp(float a, float b) {
  float low = min(a, b);
  float high = max(a, b);
  float span = high - low;
  vec2 inside = clamp(vec2(low, high), 0.0, 1.0);
  if (span < 1e-5) return inside.x;
  return (0.5 * (inside.x + inside.y) * (inside.y - inside.x) + max(high - max(low, 1.0), 0.0)) / span;
}
)";

/// The exact area of the pixel inside a polygon: the sum over its edges of the area of the pixel to the right
/// of the edge, in the rows that the edge passes, counted negative for edges that go up (the signed areas of
/// scan conversion; Levien, font-rs, 2016). The last step makes what is nearly nothing or nearly whole
/// exactly so.
constexpr const char* kPolygon = R"(
float rightOf(vec2 pixel, vec2 from, vec2 to) {
  vec2 along = to - from;
  float run = along.y != 0.0 ? along.x / along.y : 0.0;
  vec2 at = from - pixel; // from the pixel's upper left corner
  vec2 rows = clamp(vec2(at.y, to.y - pixel.y), 0.0, 1.0);
  vec2 x = at.x + (rows - at.y) * run;
  return (rows.y - rows.x) * meanClamp(1.0 - x.x, 1.0 - x.y);
}

float settled(float area) { return clamp(area * 1.0004 - 0.0002, 0.0, 1.0); }

float insideQuad(vec2 p) {
  vec2 pixel = p - 0.5;
  return settled(abs(rightOf(pixel, vOuter.xy, vOuter.zw) + rightOf(pixel, vOuter.zw, vInner.xy) +
                     rightOf(pixel, vInner.xy, vInner.zw) + rightOf(pixel, vInner.zw, vOuter.xy)));
}
)";

constexpr const char* kArrow = R"(
float insideArrow(vec2 p) {
  vec2 pixel = p - 0.5;
  float area = rightOf(pixel, vOuter.xy, vOuter.zw) + rightOf(pixel, vOuter.zw, vInner.xy) +
               rightOf(pixel, vInner.xy, vInner.zw) + rightOf(pixel, vInner.zw, vMore.xy) +
               rightOf(pixel, vMore.xy, vMore.zw) + rightOf(pixel, vMore.zw, vRest) +
               rightOf(pixel, vRest, vOuter.xy);
  return settled(abs(area));
}
)";

/// 1 where the pixel belongs to this piece of a path, else 0. Two pieces that meet have the same floats for
/// their cut, and `precise` the same arithmetic, so a pixel belongs to exactly one of them.
constexpr const char* kCuts = R"(
float owned() {
  precise float low = vMore.x * gl_FragCoord.x + vMore.y * gl_FragCoord.y + vMore.z;
  precise float high = vMore.w * gl_FragCoord.x + vRest.x * gl_FragCoord.y + vRest.y;
  return low >= 0.0 && high < 0.0 ? 1.0 : 0.0;
}
)";

/// The pixel's area between two parallel lines: that behind one less that behind the other. Behind a line the
/// area is the mean over the pixel of a height that grows evenly along the axis that the line crosses less
/// steeply.
constexpr const char* kStrip = R"(
float behind(float depth, float slope, float scale) {
  float height = depth * scale + 0.5;
  return meanClamp(height - 0.5 * slope, height + 0.5 * slope);
}

float insideStrip(vec2 p) {
  vec2 n = abs(vOuter.xy);
  float scale = 1.0 / larger(n.x, n.y);
  float slope = smaller(n.x, n.y) * scale;
  float at = vOuter.x * p.x + vOuter.y * p.y + vOuter.z;
  return (behind(vOuter.w - at, slope, scale) - behind(-vOuter.w - at, slope, scale)) * owned();
}
)";

/// Sixteen columns over the pixel. In each the path's two arms, every one a straight line with round ends,
/// take up an interval: between the tangents while the column lies between the ends' points of tangency, else
/// on the circle of an end. What both arms take up counts once. A column that an arm's end cuts off counts by
/// its part.
constexpr const char* kElbow = R"(
struct Arm {
  vec2 left, right; // its ends
  float tangent; // of the upper tangent's points, from the ends along u; of the lower one negative
  float slope, rise;
};

Arm armOf(vec2 a, vec2 b, float r) {
  Arm arm;
  bool ordered = a.x <= b.x;
  arm.left = ordered ? a : b;
  arm.right = ordered ? b : a;
  vec2 along = arm.right - arm.left;
  float whole = max(sqrt(along.x * along.x + along.y * along.y), 1e-6);
  float run = max(along.x, 1e-6);
  arm.tangent = -along.y / whole * r;
  arm.slope = along.y / run;
  arm.rise = r * whole / run;
  return arm;
}

/// The width of the column inside the arm, then the interval's ends.
vec3 columnOf(Arm arm, float r, float u, float halfWidth) {
  float first = max(u - halfWidth, arm.left.x - r);
  float last = min(u + halfWidth, arm.right.x + r);
  float at = 0.5 * (first + last);
  float fromLeft = at - arm.left.x;
  float fromRight = at - arm.right.x;
  float onLeft = sqrt(max(r * r - fromLeft * fromLeft, 0.0));
  float onRight = sqrt(max(r * r - fromRight * fromRight, 0.0));
  float middle = arm.left.y + fromLeft * arm.slope;
  float upper = fromLeft < arm.tangent ? arm.left.y + onLeft
                : fromRight > arm.tangent ? arm.right.y + onRight : middle + arm.rise;
  float lower = fromLeft < -arm.tangent ? arm.left.y - onLeft
                : fromRight > -arm.tangent ? arm.right.y - onRight : middle - arm.rise;
  return vec3(max(last - first, 0.0), lower, upper);
}

float insideElbow(vec2 position) {
  bool exchanged = vInner.w > 0.5;
  vec2 p = exchanged ? position.yx : position;
  float r = vInner.z;
  Arm first = armOf(vOuter.xy, vOuter.zw, r);
  Arm second = armOf(vOuter.zw, vInner.xy, r);
  float area = 0.0;
  for (int i = 0; i < 16; ++i) {
    float u = p.x - 0.5 + (float(i) + 0.5) * 0.0625;
    vec3 a = columnOf(first, r, u, 0.03125);
    vec3 b = columnOf(second, r, u, 0.03125);
    a.yz = clamp(a.yz - p.y, -0.5, 0.5);
    b.yz = clamp(b.yz - p.y, -0.5, 0.5);
    area += a.x * max(a.z - a.y, 0.0) + b.x * max(b.z - b.y, 0.0);
    area -= min(a.x, b.x) * max(min(a.z, b.z) - max(a.y, b.y), 0.0);
  }
  return clamp(area, 0.0, 1.0) * owned();
}
)";

} // namespace

std::string pathFunctions(Coverage coverage) {
  const std::string mean = kMeanClamp;
  switch (coverage) {
  case Coverage::Quad:
    return mean + kPolygon;
  case Coverage::Arrow:
    return mean + kPolygon + kArrow;
  case Coverage::Strip:
    return mean + kCuts + kStrip;
  case Coverage::Elbow:
    return std::string(kCuts) + kElbow;
  default:
    return {};
  }
}

const char* pathExpression(Coverage coverage) {
  switch (coverage) {
  case Coverage::Quad:
    return "insideQuad(fromOrigin())";
  case Coverage::Arrow:
    return "insideArrow(fromOrigin())";
  case Coverage::Strip:
    return "insideStrip(gl_FragCoord.xy)";
  case Coverage::Elbow:
    return "insideElbow(fromOrigin())";
  default:
    return "";
  }
}

} // namespace offstage
