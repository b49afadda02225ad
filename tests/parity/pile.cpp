// pile N STEPS: the state hash of workload S with N circles after so many steps.
#include "src/sim/world.h"
#include "tests/support/workload_s.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: pile N STEPS\n", stderr);
    return 2;
  }
  offstage::World world(offstage::test::WorkloadS(std::atoi(argv[1])).setup);
  const offstage::Clock clock = offstage::Clock::fixed(60, std::atoi(argv[2]));
  while (world.frame() < clock.steps()) world.step(clock.tick(world.frame() + 1));
  std::printf("%016" PRIx64 "\n", world.stateHash());
  return 0;
}
