#pragma once

#include "tests/bench/measure.h"
#include "tests/support/workload_s.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

namespace offstage::bench {

/// How a simulation of workload S stands, in metres and with y up.
struct SimState {
  double x, y, vx, vy;
};

/// What overlapping pairs there are, in radii. A grid of cells of one diameter holds the circles by rows.
struct SimOverlaps {
  double mean = 0.0, worst = 0.0;
};
inline SimOverlaps overlapsOf(std::span<const SimState> states, double side) {
  const double diameter = 2.0 * test::WorkloadS::kRadius;
  const int cells = std::max(1, static_cast<int>(side / diameter));
  std::vector<std::vector<const SimState*>> grid(static_cast<std::size_t>(cells) *
                                                 static_cast<std::size_t>(cells));
  const auto cellOf = [&](double v) { return std::clamp(static_cast<int>(v / side * cells), 0, cells - 1); };
  const auto cellAt = [cells](int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells) + static_cast<std::size_t>(column);
  };
  SimOverlaps overlaps;
  std::size_t count = 0;
  for (const SimState& state : states) { // each with those before it
    const int cx = cellOf(state.x);
    const int cy = cellOf(state.y);
    for (int row = std::max(cy - 1, 0); row <= std::min(cy + 1, cells - 1); ++row) {
      for (int column = std::max(cx - 1, 0); column <= std::min(cx + 1, cells - 1); ++column) {
        for (const SimState* other : grid[cellAt(row, column)]) {
          const double overlap = diameter - std::hypot(other->x - state.x, other->y - state.y);
          if (!(overlap > 0.0)) continue;
          overlaps.worst = std::max(overlaps.worst, overlap / test::WorkloadS::kRadius);
          overlaps.mean += overlap / test::WorkloadS::kRadius;
          ++count;
        }
      }
    }
    grid[cellAt(cy, cx)].push_back(&state);
  }
  overlaps.mean /= static_cast<double>(std::max<std::size_t>(count, 1));
  return overlaps;
}

/// `PROGRAM N STEPS`: runs workload S and prints, on one line: CPU ms a step, mean overlap, worst overlap (in
/// radii), energy at the start and at the end (J a body of 1 kg), bodies outside the box, peak memory that
/// the simulation added to the workload's own, code aside (bytes a body). Engine: constructed from a
/// WorkloadS; step(); state(i).
template <typename Engine>
int simMain(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s N STEPS\n", argv[0]);
    return 2;
  }
  const int count = std::atoi(argv[1]);
  const int steps = std::atoi(argv[2]);
  std::vector<SimState> states(static_cast<std::size_t>(count));
  const auto readAll = [&](const Engine& engine) {
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = engine.state(i);
  };
  const auto energy = [&] {
    double sum = 0.0;
    for (const SimState& s : states) {
      sum += 0.5 * (s.vx * s.vx + s.vy * s.vy) + test::WorkloadS::kGravity * s.y;
    }
    return sum / count;
  };
  {
    Engine small{test::WorkloadS(16)}; // brings the code into memory
    for (int i = 0; i < 60; ++i) small.step();
  }
  const test::WorkloadS workload(count);
  const double side = workload.side;
  restartPeak();
  const std::size_t memoryBefore = peakKib();
  Engine engine(workload);
  readAll(engine);
  const double energyBefore = energy();
  const double start = cpuSeconds();
  for (int i = 0; i < steps; ++i) engine.step();
  const double ms = 1e3 * (cpuSeconds() - start) / steps;
  const std::size_t memory = peakKib() - memoryBefore;
  readAll(engine);
  const auto outside = std::count_if(states.begin(), states.end(), [&](const SimState& s) {
    return !(s.x > 0.0 && s.x < side && s.y > 0.0 && s.y < side);
  });
  const SimOverlaps overlaps = overlapsOf(states, side);
  std::printf("%.4f %.4f %.4f %.3f %.3f %td %.0f\n", ms, overlaps.mean, overlaps.worst, energyBefore,
              energy(), outside, 1024.0 * static_cast<double>(memory) / count);
  return 0;
}

} // namespace offstage::bench
