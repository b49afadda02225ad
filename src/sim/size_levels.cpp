#include "src/sim/size_levels.h"

#include <algorithm>
#include <cmath>

namespace offstage {

double extentOf(const Body& body) {
  return body.shape == Shape::Circle ? 2.0 * body.radius : std::max(body.size.x(), body.size.y());
}

std::size_t SizeLevels::octaveOf(double extent) {
  if (!(extent < 0x1p+63)) return kOctaves;
  if (extent < 0x1p-64) return 0;
  const int octave = std::ilogb(extent) + 64;
  return static_cast<std::size_t>(octave);
}

void SizeLevels::layOut() {
  std::size_t ofPoints = 1;
  while (ofPoints < kOctaves && counts_[ofPoints] == 0) ++ofPoints;
  if (ofPoints == kOctaves) ofPoints = kOctaves / 2; // all are points
  counts_[ofPoints] += counts_[0];
  counts_[0] = 0;
  members_.clear();
  levelOf_.fill(kUnbounded);
  for (std::size_t octave = 1; octave < kOctaves; ++octave) {
    if (counts_[octave] == 0) continue;
    levelOf_[octave] = static_cast<std::uint32_t>(members_.size());
    members_.push_back(counts_[octave]);
    if (octave + 1 < kOctaves && counts_[octave + 1] > 0) {
      ++octave;
      levelOf_[octave] = levelOf_[octave - 1];
      members_.back() += counts_[octave];
    }
  }
  levelOf_[0] = levelOf_[ofPoints];
}

} // namespace offstage
