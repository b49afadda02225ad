// Pen::path: a path cut into pieces that each belong to other pixels.
#include "render/draw/pen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace offstage {
namespace {

/// The cosine of 6°. Up to such a turn a pixel on the seam of two straight pieces is off by at most 3.3/255.
constexpr double kSmoothCosine = 0.9945;

/// Two arms of a corner lie over each other up to half the width times the tangent of half its turn; of
/// corners sharper than this many half widths the arms' far parts show twice.
constexpr double kLongestOverlap = 8.0;

constexpr double kStraight = 0.6;     ///< px; beside a sharp corner such a bend is not seen
constexpr double kBluntCosine = 0.76; ///< of 40°
constexpr double kFarthest = 32768.0; ///< px

struct Segment {
  Vec2 from;
  Vec2 ahead; ///< of length 1
  double length;
  Rgba8 color;

  [[nodiscard]] Vec2 at(double distance) const { return from + ahead * distance; }
};

/// The place where a piece ends and the next begins.
struct Seam {
  Vec2 at;
  Vec2 normal;
};

Primitive piece(Primitive::Kind kind, double halfWidth, const Seam& low, const Vec2& corner,
                const Seam& high) {
  Primitive primitive;
  primitive.kind = kind;
  primitive.outer = halfWidth;
  primitive.low = low.at;
  primitive.center = corner;
  primitive.high = high.at;
  primitive.innerLow = low.normal;
  primitive.innerHigh = high.normal;
  return primitive;
}

/// A point of a path, and the colour of the segment that begins there.
struct Point {
  Vec2 at;
  Rgba8 color;
};

/// Consecutive points that differ. A point that cannot be drawn ends the run; returns where the next begins.
std::size_t takeRun(std::span<const Vec2> points, std::span<const Rgba8> colors, Rgba8 color,
                    std::size_t first, std::vector<Point>& run) {
  const auto usable = [](const Vec2& p) {
    return std::abs(p.x()) <= kFarthest && std::abs(p.y()) <= kFarthest;
  };
  run.clear();
  while (first < points.size() && !usable(points[first])) ++first;
  std::size_t i = first;
  for (; i < points.size() && usable(points[i]); ++i) {
    const Rgba8 own = i < colors.size() ? colors[i] : color;
    if (!run.empty() && !(length(points[i] - run.back().at) > 1e-9)) {
      run.back().color = own;
    } else {
      run.push_back({points[i], own});
    }
  }
  return i;
}

/// How far from a corner its two arms lie over each other.
double overlapOf(double cosine, double halfWidth) {
  const double tangent = std::sqrt(std::max(1.0 - cosine, 0.0) / std::max(1.0 + cosine, 1e-9));
  return halfWidth * std::min(tangent, kLongestOverlap) + 1.0;
}

double cosineAt(const std::vector<Point>& run, std::size_t i) {
  const Vec2 one = run[i].at - run[i - 1].at;
  const Vec2 two = run[i + 1].at - run[i].at;
  return one.dot(two) / (length(one) * length(two));
}

/// Of two corners nearer to each other than half the line's width only the sharper stays: the line hides the
/// difference, and their arms could not be told apart.
void mergeCorners(std::vector<Point>& run, double halfWidth) {
  for (std::size_t i = 1; i + 2 < run.size();) {
    const double one = cosineAt(run, i);
    const double two = cosineAt(run, i + 1);
    if (one >= kSmoothCosine || two >= kSmoothCosine || length(run[i + 1].at - run[i].at) >= halfWidth) {
      ++i;
    } else {
      run.erase(run.begin() + static_cast<std::ptrdiff_t>(one > two ? i : i + 1));
    }
  }
}

/// Takes points out of the arms of sharp corners, where these are too short to hold the part that both arms
/// cover, as long as the path is straight there within kStraight.
void lengthenArms(std::vector<Point>& run, double halfWidth) {
  if (run.size() < 4) return;
  std::vector<double> cosines(run.size(), 1.0);
  for (std::size_t i = 1; i + 1 < run.size(); ++i) cosines[i] = cosineAt(run, i);
  std::vector<bool> dropped(run.size(), false);
  for (std::size_t corner = 1; corner + 1 < run.size(); ++corner) {
    if (cosines[corner] >= kSmoothCosine || dropped[corner]) continue;
    const double wanted = 1.2 * overlapOf(cosines[corner], halfWidth);
    const Vec2 at = run[corner].at;
    for (const int side : {-1, 1}) {
      const auto along = [&](std::size_t i) {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + side);
      };
      std::size_t i = along(corner);
      while (i > 0 && i + 1 < run.size() && cosines[i] >= kBluntCosine && cosines[i] > cosines[corner] &&
             length(run[i].at - at) < wanted) {
        const Vec2 arm = run[along(i)].at - at;
        const Vec2 aside = Vec2(-arm.y(), arm.x()) / length(arm);
        bool straight = true;
        for (std::size_t k = along(corner); k != along(i); k = along(k))
          straight = straight && std::abs(aside.dot(run[k].at - at)) <= kStraight;
        if (!straight) break;
        dropped[i] = true;
        i = along(i);
      }
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < run.size(); ++i)
    if (!dropped[i]) run[kept++] = run[i];
  run.resize(kept);
}

std::vector<Segment> segmentsOf(const std::vector<Point>& run) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    const Vec2 along = run[i + 1].at - run[i].at;
    const double distance = length(along);
    segments.push_back({run[i].at, along / distance, distance, run[i].color});
  }
  return segments;
}

} // namespace

void Pen::path(std::span<const Vec2> points, std::span<const Rgba8> colors, PathEnds ends) {
  using Kind = Primitive::Kind;
  const double half = 0.5 * width_;
  const Vec2 none = Vec2::Zero();
  std::vector<Point> run;
  for (std::size_t next = 0; next < points.size();) {
    next = takeRun(points, colors, color_, next, run);
    mergeCorners(run, half);
    lengthenArms(run, half);
    const std::vector<Segment> segments = segmentsOf(run);
    if (segments.empty()) continue;
    const Segment& first = segments.front();
    const Segment& last = segments.back();
    const Vec2 end = last.at(last.length);
    if (segments.size() == 1 && ends.roundFirst && ends.roundLast) {
      add(piece(Kind::Elbow, half, {first.from, none}, end, {end, none}), first.color);
      continue;
    }
    Seam seam{first.from, first.ahead};
    if (ends.roundFirst) {
      seam.at = first.at(std::min(1.0, 0.5 * first.length));
      add(piece(Kind::Elbow, half, {first.from, none}, first.from, seam), first.color);
    }
    for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
      const Segment& one = segments[i];
      const Segment& two = segments[i + 1];
      const double cosine = one.ahead.dot(two.ahead);
      const auto strip = [&](const Seam& to) {
        if (to.at != seam.at) add(piece(Kind::Strip, half, seam, to.at, to), one.color);
      };
      if (cosine >= kSmoothCosine) {
        const Seam joint{two.from, one.ahead};
        strip(joint);
        seam = joint;
        continue;
      }
      // Two corners share the segment between them; of any other an arm may take nearly all.
      const auto room = [&](const Segment& segment, std::size_t beyond) {
        const bool shared =
            beyond < segments.size() && segment.ahead.dot(segments[beyond].ahead) < kSmoothCosine;
        return (shared ? 0.5 : 0.9) * segment.length;
      };
      const double arm = std::min({overlapOf(cosine, half), room(one, i - 1), room(two, i + 2)});
      const Seam before{one.at(one.length - arm), one.ahead};
      const Seam after{two.at(arm), two.ahead};
      strip(before);
      add(piece(Kind::Elbow, half, before, two.from, after), two.color);
      seam = after;
    }
    Seam before{end, last.ahead};
    if (ends.roundLast) {
      before.at = last.at(last.length - std::min(1.0, 0.25 * last.length));
      add(piece(Kind::Elbow, half, before, end, {end, none}), last.color);
    }
    add(piece(Kind::Strip, half, seam, before.at, before), last.color);
  }
}

} // namespace offstage
