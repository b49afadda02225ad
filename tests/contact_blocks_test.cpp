#include "src/sim/contact_blocks.h"
#include "src/sim/random.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr std::uint32_t kBodies = 150;

double between(Random& random, double low, double high) {
  return low + (high - low) * random.nextDouble();
}

/// The bits of all velocities and impulses after a few sweeps over random contacts, some with fixed bodies.
/// `even`: all bodies that can move have one mass. `kept`: whether their shares are kept nevertheless.
std::vector<std::uint64_t> bitsAfterSweeps(bool wide, int contacts, bool even, bool kept) {
  Random random(11);
  std::vector<SlotState> states(kBodies + 2); // and the outside, and nobody
  for (std::uint32_t slot = 0; slot < kBodies; ++slot) {
    states[slot] = {between(random, -9, 9), between(random, -9, 9), between(random, 0, 50),
                    between(random, 0, 50)};
  }
  states[7].vx = std::nan("");
  ContactBlocks blocks(wide);
  blocks.begin(kBodies + 1, even && !kept);
  for (int i = 0; i < contacts; ++i) {
    PileContact contact;
    contact.a = static_cast<std::uint32_t>(random.nextInt(kBodies));
    contact.b = random.nextInt(8) == 0
                    ? kBodies
                    : (contact.a + 1 + static_cast<std::uint32_t>(random.nextInt(20))) % kBodies;
    contact.nx = between(random, -1, 1);
    contact.ny = std::sqrt(1.0 - contact.nx * contact.nx);
    contact.touch = between(random, -1, 20);
    contact.share = contact.b == kBodies ? 1.0 : even ? 0.5 : between(random, 0, 1);
    contact.impulse = between(random, 0, 0.5);
    blocks.add(contact);
  }
  blocks.warmStart(states);
  for (int i = 0; i < 4; ++i) {
    blocks.solve(states, 1.0 / 240.0, {.rate = 20.0, .mass = 0.9, .impulse = 0.1});
    blocks.relax(states, 1.0 / 240.0);
  }
  std::vector<std::uint64_t> bits;
  const auto keep = [&](double value) {
    bits.push_back(std::isnan(value) ? 0 : std::bit_cast<std::uint64_t>(value)); // NaNs have many
  };
  for (const SlotState& state : states) {
    keep(state.vx);
    keep(state.vy);
  }
  blocks.forEach([&](const PileContact& contact) { keep(contact.impulse); });
  return bits;
}

TEST(ContactBlocks, FourAtATimeGiveTheBitsOfTwo) {
  if (!processorIsWide()) GTEST_SKIP() << "this processor has no AVX2";
  for (const int contacts : {1, 2, 3, 5, 60, 400, 3000}) { // from 3000 on the last colour has many
    for (const bool even : {false, true}) {
      const auto wide = bitsAfterSweeps(true, contacts, even, false);
      const auto narrow = bitsAfterSweeps(false, contacts, even, false);
      ASSERT_EQ(wide.size(), 2 * (kBodies + 2) + static_cast<std::size_t>(contacts));
      for (std::size_t i = 0; i < wide.size(); ++i) {
        ASSERT_EQ(wide[i], narrow[i]) << "value " << i << " of " << wide.size() << " with " << contacts
                                      << " contacts" << (even ? " of one mass" : "");
      }
    }
  }
}

TEST(ContactBlocks, SharesThatAreEvenAndNotKeptGiveTheBitsOfThoseThatAre) {
  for (const bool wide : {false, processorIsWide()}) {
    for (const int contacts : {1, 7, 400}) {
      EXPECT_EQ(bitsAfterSweeps(wide, contacts, true, false), bitsAfterSweeps(wide, contacts, true, true))
          << contacts << " contacts, " << (wide ? "four" : "two") << " at a time";
    }
  }
}

} // namespace
} // namespace offstage::test
