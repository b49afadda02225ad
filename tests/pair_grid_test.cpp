#include "src/sim/contact.h"
#include "src/sim/pair_grid.h"
#include "src/sim/random.h"
#include "tests/support/sim_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// Puts the bodies where they are now into a grid that is laid out; their slots.
std::vector<std::uint32_t> fill(PairGrid& grid, std::span<const Body> bodies) {
  PairGrid::Counting counting = grid.startCounting();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) counting.add(i, PairGrid::centreOf(bodies[i]));
  grid.startInserting();
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) slots.push_back(grid.insert(i));
  grid.end();
  return slots;
}

TEST(PairGrid, FindsEveryNearPairOnce) {
  Random random(3);
  for (const double spread : {1.0, 3.0, 500.0}) { // of the sizes
    std::vector<Body> bodies;
    for (int i = 0; i < 600; ++i) {
      const double size = 2.0 * std::pow(spread, random.nextDouble());
      const double x = random.nextInt(50) == 0 ? 1e9 * random.nextDouble() : 400.0 * random.nextDouble();
      const double y = 300.0 * random.nextDouble() - 100.0;
      bodies.push_back(random.nextInt(4) == 0 ? rectangle(x, y, size, 0.3 * size) : circle(x, y, size));
    }
    bodies.push_back(circle(50, 50, 1e25)); // too large for any grid
    bodies.push_back(circle(std::numeric_limits<double>::quiet_NaN(), 0, 5));
    std::vector<std::uint8_t> paired(bodies.size(), 1);
    paired[7] = 0;
    PairGrid grid;
    grid.layOut(bodies, paired, 0.25);
    const std::vector<std::uint32_t> slots = fill(grid, bodies);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> found;
    grid.forEachRun([&](std::uint32_t slot) { return PairGrid::centreOf(bodies[grid.order()[slot]]); },
                    [&](std::uint32_t slot, std::uint32_t first, std::uint32_t end) {
                      for (std::uint32_t other = first; other < end; ++other)
                        ++found[std::minmax(slot, other)];
                    });
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
      for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
        const double reach = 0.125 * std::max(extentOf(bodies[i]), extentOf(bodies[j]));
        const bool near =
            paired[i] != 0 && paired[j] != 0 && findContact(bodies[i], bodies[j], reach).has_value();
        const auto pair = found.find(std::minmax(slots[i], slots[j]));
        const int times = pair == found.end() ? 0 : pair->second;
        if (near) {
          ASSERT_EQ(times, 1) << i << " and " << j << ", sizes over " << spread;
        }
        if (paired[i] == 0 || paired[j] == 0) {
          ASSERT_EQ(times, 0);
        }
      }
    }
    if (spread < 100.0) {
      EXPECT_LT(found.size(), bodies.size() * 40) << "sizes over " << spread;
    }
  }
}

TEST(PairGrid, ColumnOfBodiesThatSpreadsHasFewNeighboursAgain) {
  std::vector<Body> bodies;
  bodies.reserve(4000);
  for (int row = 0; row < 1000; ++row)
    for (int column = 0; column < 4; ++column) bodies.push_back(circle(10 + 20 * column, 20 * row, 10));
  const std::vector<std::uint8_t> paired(bodies.size(), 1);
  PairGrid grid;
  std::size_t pairs = 0;
  const auto lookAtAll = [&](bool first) {
    if (first) grid.layOut(bodies, paired, 0.25);
    fill(grid, bodies);
    pairs = 0;
    grid.forEachRun([&](std::uint32_t slot) { return PairGrid::centreOf(bodies[grid.order()[slot]]); },
                    [&](std::uint32_t, std::uint32_t from, std::uint32_t end) { pairs += end - from; });
  };
  lookAtAll(true);
  EXPECT_LT(pairs, bodies.size() * 12) << "a column 4 wide";
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::size_t row = i / 400;
    bodies[i].position = Vec2(20.0 * static_cast<double>(i % 400), 20.0 * static_cast<double>(row));
  }
  lookAtAll(false);
  lookAtAll(false);
  EXPECT_LT(pairs, bodies.size() * 12) << "a layer 400 wide";
}

} // namespace
} // namespace offstage::test
