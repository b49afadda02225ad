#pragma once

#include <cstdint>
#include <vector>

namespace offstage::bench {

/// The generator of the workloads: a linear congruential one with the constants of Numerical Recipes, of
/// which the upper 24 bits are used.
class Lcg {
public:
  explicit Lcg(std::uint32_t seed) : state_(seed) {}
  double next() { ///< 0 … 1
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8U) * (1.0 / 16777216.0);
  }

private:
  std::uint32_t state_;
};

struct Circle {
  double x, y;   ///< px
  double vx, vy; ///< px/s
  std::uint8_t r, g, b;
};

/// Workload R: circles that cross a 1920×1080 pane and bounce off its edges, 60 frames a second.
struct MovingCircles {
  static constexpr int kWidth = 1920;
  static constexpr int kHeight = 1080;
  double radius;
  std::vector<Circle> circles;

  explicit MovingCircles(int count) : radius(count <= 100 ? 40.0 : count <= 1000 ? 12.0 : 6.0) {
    Lcg random(1);
    for (int i = 0; i < count; ++i) {
      Circle circle{};
      circle.x = radius + random.next() * (kWidth - 2.0 * radius);
      circle.y = radius + random.next() * (kHeight - 2.0 * radius);
      circle.vx = (2.0 * random.next() - 1.0) * 240.0;
      circle.vy = (2.0 * random.next() - 1.0) * 240.0;
      for (std::uint8_t* channel : {&circle.r, &circle.g, &circle.b}) {
        *channel = static_cast<std::uint8_t>(32 + static_cast<int>(random.next() * 192.0));
      }
      circles.push_back(circle);
    }
  }

  void step() {
    const auto move = [this](double& position, double& velocity, double size) {
      position += velocity / 60.0;
      const double low = radius;
      const double high = size - radius;
      if (position < low) {
        position = 2.0 * low - position;
        velocity = -velocity;
      }
      if (position > high) {
        position = 2.0 * high - position;
        velocity = -velocity;
      }
    };
    for (Circle& circle : circles) {
      move(circle.x, circle.vx, kWidth);
      move(circle.y, circle.vy, kHeight);
    }
  }
};

/// One texel of the 64×64 image of variant P, as 0xRRGGBB.
inline std::uint32_t patternTexel(std::uint32_t x, std::uint32_t y) {
  const std::uint32_t blue = (x / 8 + y / 8) % 2 != 0 ? 255 : 64;
  return 4 * x << 16U | 4 * y << 8U | blue;
}
inline constexpr std::uint32_t kPatternSide = 64;

} // namespace offstage::bench
