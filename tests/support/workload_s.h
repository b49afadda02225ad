#pragma once

#include "src/sim/world_setup.h"
#include "tests/bench/workload.h"

#include <cmath>
#include <numbers>

namespace offstage::test {

/// Workload S: circles of 0.25 m in a closed box of which they fill 40 %, thrown about at up to 2 m/s, under
/// 9.81 m/s². The scene's unit is the metre; y points down.
struct WorkloadS {
  static constexpr double kRadius = 0.25;
  static constexpr double kGravity = 9.81;
  static constexpr double kRestitution = 0.8;

  explicit WorkloadS(int count) : side(kRadius * std::sqrt(count * std::numbers::pi / 0.4)) {
    setup.pane = Vec2(side, side);
    setup.gravity = Vec2(0.0, kGravity);
    setup.contactModel = ContactModel::Solver;
    setup.substeps = 4;
    setup.walls.restitution.fill(kRestitution);
    setup.contacts = {{.restitution = kRestitution}};
    bench::Lcg random(1);
    const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
    const double cell = side / columns;
    const double jitter = 0.45 * (cell - 2.0 * kRadius);
    const auto spread = [&] { return 2.0 * random.next() - 1.0; };
    for (int i = 0; i < count; ++i) {
      const int row = i / columns;
      Body body;
      body.radius = kRadius;
      const double x = (i % columns + 0.5) * cell + spread() * jitter; // the order of the draws matters
      const double y = (row + 0.5) * cell + spread() * jitter;
      const double vx = spread() * 2.0;
      const double vy = spread() * 2.0;
      body.position = Vec2(x, side - y);
      body.velocity = Vec2(vx, -vy);
      setup.bodies.push_back(body);
    }
  }

  double side; ///< m: of the box
  WorldSetup setup;
};

} // namespace offstage::test
