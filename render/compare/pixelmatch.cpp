#include "render/compare/pixelmatch.h"

#include "render/compare/parallel.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

namespace offstage {
namespace {

/// 35215: the largest squared distance that two colours can have.
constexpr double kThreshold = 0.1;
constexpr double kLargestDistance = 35215 * kThreshold * kThreshold;

/// Differences of red, green and blue.
struct ColorStep {
  double red, green, blue;
};

int channel(std::uint32_t pixel, unsigned index) {
  return static_cast<int>((pixel >> (8U * index)) & 0xFFU);
}

/// 48 or 207 in a pattern over the picture. JavaScript's `| 0` and `%` on what may exceed 32 bits.
double patternColor(double quotient) {
  const auto whole = static_cast<std::int32_t>(static_cast<std::int64_t>(quotient));
  return 48 + 159 * (whole % 2);
}

/// The step from b to a; `place`: four times the number of the pixel whose background is taken.
ColorStep colorStep(std::uint32_t a, std::uint32_t b, std::int64_t place) {
  const int alphaA = channel(a, 3);
  const int alphaB = channel(b, 3);
  std::array<double, 3> step{};
  if (alphaA == 255 && alphaB == 255) {
    for (unsigned c = 0; c < 3; ++c) step[c] = channel(a, c) - channel(b, c);
  } else {
    const auto at = static_cast<double>(place);
    const std::array<double, 3> background{48.0 + 159.0 * static_cast<double>(place % 2),
                                           patternColor(at / 1.618033988749895),
                                           patternColor(at / 2.618033988749895)};
    for (unsigned c = 0; c < 3; ++c)
      step[c] = (channel(a, c) * alphaA - channel(b, c) * alphaB - background[c] * (alphaA - alphaB)) / 255;
  }
  return {step[0], step[1], step[2]};
}

/// The Y of YIQ.
double brightness(const ColorStep& d) {
  return d.red * 0.29889531 + d.green * 0.58662247 + d.blue * 0.11448223;
}

double distance(const ColorStep& d) {
  const double y = brightness(d);
  const double i = d.red * 0.59597799 - d.green * 0.27417610 - d.blue * 0.32180189;
  const double q = d.red * 0.21147017 - d.green * 0.52261711 + d.blue * 0.31114694;
  return 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q;
}

/// The up to eight neighbours of a place, columns outermost: the order decides between equals.
template <class F>
bool forEachNeighbour(const RowWindow& window, int x, int y, F f) {
  for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, window.width() - 1); ++nx) {
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, window.height() - 1); ++ny) {
      if ((nx != x || ny != y) && !f(nx, ny)) return false;
    }
  }
  return true;
}

bool onBorder(const RowWindow& window, int x, int y) {
  return x == 0 || y == 0 || x == window.width() - 1 || y == window.height() - 1;
}

/// At least three neighbours of the same colour; the border counts as one.
bool inFlatPart(const RowWindow& window, int x, int y) {
  const std::uint32_t color = window.row(y)[x];
  int alike = onBorder(window, x, y) ? 1 : 0;
  return !forEachNeighbour(window, x, y, [&](int nx, int ny) {
    if (window.row(ny)[nx] == color) ++alike;
    return alike <= 2;
  });
}

} // namespace

bool looksAntialiased(const RowWindow& in, const RowWindow& other, int x) {
  const int y = in.y();
  const std::uint32_t center = in.row(y)[x];
  const std::int64_t place = 4 * (static_cast<std::int64_t>(y) * in.width() + x);
  int alike = onBorder(in, x, y) ? 1 : 0;
  double darkest = 0.0;
  double brightest = 0.0;
  std::array<int, 2> darkestAt{};
  std::array<int, 2> brightestAt{};
  const bool few = forEachNeighbour(in, x, y, [&](int nx, int ny) {
    const std::uint32_t neighbour = in.row(ny)[nx];
    const double step = neighbour == center ? 0.0 : brightness(colorStep(center, neighbour, place));
    if (step == 0.0) return ++alike <= 2;
    if (step < darkest) {
      darkest = step;
      darkestAt = {nx, ny};
    } else if (step > brightest) {
      brightest = step;
      brightestAt = {nx, ny};
    }
    return true;
  });
  if (!few || darkest == 0.0 || brightest == 0.0) return false;
  const auto flatInBoth = [&](const std::array<int, 2>& at) {
    return inFlatPart(in, at[0], at[1]) && inFlatPart(other, at[0], at[1]);
  };
  return flatInBoth(darkestAt) || flatInBoth(brightestAt);
}

PixelmatchCounts pixelmatch(const PixelRows& a, const PixelRows& b, int threads) {
  std::atomic<std::int64_t> differing = 0;
  std::atomic<std::int64_t> withAa = 0;
  const bool alike = a.layout() == b.layout();
  const int width = a.width();
  parallelFor(a.height(), 64, threads, [&](int, int begin, int end) {
    RowWindow windowA(a);
    RowWindow windowB(b);
    std::int64_t here = 0;
    std::int64_t hereWithAa = 0;
    for (int y = begin; y < end; ++y) {
      if (alike && std::memcmp(a.stored(y).data(), b.stored(y).data(), a.stored(y).size()) == 0) continue;
      windowA.moveTo(y);
      windowB.moveTo(y);
      const std::uint32_t* rowA = windowA.row(y);
      const std::uint32_t* rowB = windowB.row(y);
      for (int x = 0; x < width; ++x) {
        if (rowA[x] == rowB[x]) continue;
        const std::int64_t place = 4 * (static_cast<std::int64_t>(y) * width + x);
        if (distance(colorStep(rowA[x], rowB[x], place)) <= kLargestDistance) continue;
        ++hereWithAa;
        if (!looksAntialiased(windowA, windowB, x) && !looksAntialiased(windowB, windowA, x)) ++here;
      }
    }
    differing += here;
    withAa += hereWithAa;
  });
  return {differing, withAa};
}

} // namespace offstage
