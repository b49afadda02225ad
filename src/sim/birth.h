#pragma once

#include "src/sim/body.h"
#include "src/sim/random.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <optional>
#include <span>

namespace offstage {

/// Draws the body that a spawner makes as its `number`-th (from 0); its id is still to be given. `index` is
/// the spawner's number in the setup.
Body drawBody(const Spawner& spawner, std::uint32_t index, std::int64_t number, Random& random);

/// From where to where a step leads.
struct StepSpan {
  std::int64_t frameBefore = 0;   ///< in which the step before it was made; 0: it is the first one
  std::int64_t frame = 1;         ///< in which it is made
  double before = 0.0, now = 0.0; ///< s of simulated time
};

/// Whether a moment falls into a step.
bool isDue(const Launch::Moment& moment, const StepSpan& step);

/// What a launch makes of the bodies as they are.
struct Shot {
  Vec2 from;                    ///< px: where it starts, or would have
  std::optional<Vec2> velocity; ///< px/s; none when there is no direction or a body that it needs is gone
};
Shot aim(const Launch& launch, const Launch::Moment& moment, std::span<const Body> bodies);

/// The living body with this id in `bodies`, which are ordered by id; null when it is gone.
const Body* findBody(std::span<const Body> bodies, std::uint32_t id);

} // namespace offstage
