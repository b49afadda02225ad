#include "src/scene/overlay.h"

#include "src/scene/palette.h"

#include <algorithm>
#include <cmath>

namespace offstage {

bool BodySelection::holds(std::uint32_t body, std::uint32_t group) const {
  return all || std::ranges::find(bodies, body) != bodies.end() ||
         std::ranges::find(groups, group) != groups.end();
}

Color arrowColor(ArrowQuantity quantity) {
  switch (quantity) {
  case ArrowQuantity::Acceleration:
    return palette::kVermilion;
  case ArrowQuantity::Force:
    return palette::kPurple;
  case ArrowQuantity::Velocity:
    break;
  }
  return palette::kBlue;
}

double roundStep(double least) {
  if (!(least > 0.0) || !std::isfinite(least)) return 1.0;
  double power = 1.0;
  while (power > least) power /= 10.0;
  while (power * 10.0 <= least) power *= 10.0;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10.0 * power;
}

} // namespace offstage
