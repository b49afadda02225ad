// Workload S with Offstage's contact solver.
#include "src/sim/world.h"
#include "tests/bench/sim_report.h"

namespace {

class OffstageEngine {
public:
  explicit OffstageEngine(const offstage::test::WorkloadS& workload)
      : side_(workload.side), world_(workload.setup) {}
  void step() {
    const auto frame = world_.frame() + 1;
    world_.step({frame, static_cast<double>(frame) / 60.0, 1.0 / 60.0});
  }
  [[nodiscard]] offstage::bench::SimState state(std::size_t i) const {
    const offstage::Body& body = world_.bodies()[i];
    return {body.position.x(), side_ - body.position.y(), body.velocity.x(), -body.velocity.y()};
  }

private:
  double side_;
  offstage::World world_;
};

} // namespace

int main(int argc, char** argv) {
  return offstage::bench::simMain<OffstageEngine>(argc, argv);
}
