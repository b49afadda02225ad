// Workload S with Chipmunk, with its spatial hash.
#include "tests/bench/sim_report.h"

#include <chipmunk/chipmunk.h>

namespace {

using offstage::test::WorkloadS;

class ChipmunkEngine {
public:
  explicit ChipmunkEngine(const WorkloadS& workload) : space_(cpSpaceNew()) {
    cpSpaceSetGravity(space_, cpv(0.0, -WorkloadS::kGravity));
    cpSpaceSetCollisionSlop(space_, 0.02 * WorkloadS::kRadius); // its default is meant for pixels
    cpSpaceUseSpatialHash(space_, 2.2 * WorkloadS::kRadius,
                          static_cast<int>(10 * workload.setup.bodies.size()));
    const double side = workload.side;
    const double thick = 5.0;
    const double elasticity = std::sqrt(WorkloadS::kRestitution); // of a pair it takes the product
    const auto wall = [&](cpVect from, cpVect to) {
      cpShape* shape =
          cpSpaceAddShape(space_, cpSegmentShapeNew(cpSpaceGetStaticBody(space_), from, to, thick));
      cpShapeSetElasticity(shape, elasticity);
    };
    wall(cpv(-thick, -thick), cpv(side + thick, -thick));
    wall(cpv(-thick, side + thick), cpv(side + thick, side + thick));
    wall(cpv(-thick, -thick), cpv(-thick, side + thick));
    wall(cpv(side + thick, -thick), cpv(side + thick, side + thick));
    for (const offstage::Body& circle : workload.setup.bodies) {
      cpBody* body =
          cpSpaceAddBody(space_, cpBodyNew(1.0, cpMomentForCircle(1.0, 0.0, circle.radius, cpvzero)));
      cpBodySetPosition(body, cpv(circle.position.x(), side - circle.position.y()));
      cpBodySetVelocity(body, cpv(circle.velocity.x(), -circle.velocity.y()));
      cpShape* shape = cpSpaceAddShape(space_, cpCircleShapeNew(body, circle.radius, cpvzero));
      cpShapeSetElasticity(shape, elasticity);
      bodies_.push_back(body);
    }
  }
  void step() { cpSpaceStep(space_, 1.0 / 60.0); }
  [[nodiscard]] offstage::bench::SimState state(std::size_t i) const {
    const cpVect position = cpBodyGetPosition(bodies_[i]);
    const cpVect velocity = cpBodyGetVelocity(bodies_[i]);
    return {position.x, position.y, velocity.x, velocity.y};
  }

private:
  cpSpace* space_; // for as long as the program runs
  std::vector<cpBody*> bodies_;
};

} // namespace

int main(int argc, char** argv) {
  return offstage::bench::simMain<ChipmunkEngine>(argc, argv);
}
