#pragma once

#include "src/sim/body.h"
#include "src/sim/force.h"
#include "src/sim/vec.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace offstage {

/// The pane's four edges, in the order in which they are tested.
enum class Side : std::uint8_t { Left, Right, Top, Bottom };

/// What happens at the pane's edges, right after a body has moved.
struct Walls {
  std::array<std::optional<double>, 4>
      restitution; ///< by Side: the multiplier on the flipped component; none: open
  /// true: only a body that moves outwards bounces, and it is put back onto the edge.
  /// false: whoever touches flips, as the exercise's sentence says word for word; nothing is moved.
  bool clamp = true;
};

/// What two touching bodies do.
enum class Response : std::uint8_t {
  Bounce,            ///< the physical one: normal components exchanged (masses and restitution included)
  Remove,            ///< every touching pair of the step goes, whatever the order
  RemoveImmediately, ///< the first touching pair in (i, j) order goes at once and touches nobody else
  Slide,             ///< the lecture slide's printed formula, v1' = v1t + v1n − v2n; it gains energy
  Report,            ///< an event, nothing else
};

/// The rule for bodies of two groups (possibly the same) that touch: d < r1 + r2, strictly.
struct ContactRule {
  std::uint32_t groupA = 0;
  std::uint32_t groupB = 0;
  Response response = Response::Bounce;
  double restitution = 1.0; ///< 0 … 1: share of the closing speed that comes back (Bounce only)
  bool separate = true; ///< push an overlapping pair apart, half each (a fixed body's half goes to the other)
  bool approachingOnly = true; ///< respond only while approaching, v1n > v2n
};

/// How bodies that touch are dealt with.
enum class ContactModel : std::uint8_t {
  Lecture, ///< the rules above, one pair after the other, once a step
  Solver,  ///< Bounce by PileSolver, which lets piles rest; everything else as in the lecture
};

/// A number of a spawner: constant, or drawn from the world's java.util.Random.
struct ConstantNumber {
  double value = 0.0;
};
struct IntegerNumber {
  std::int32_t bound = 1;
}; ///< nextInt(bound)
struct SpreadNumber {
  double half = 0.0;
}; ///< (nextDouble()*2.0 - 1.0)*half
struct UniformNumber {
  double low = 0.0;
  double high = 0.0;
}; ///< low + nextDouble()*(high - low)
struct GaussianNumber {
  double mean = 0.0;
  double deviation = 1.0;
}; ///< mean + nextGaussian()*deviation
using Number = std::variant<ConstantNumber, IntegerNumber, SpreadNumber, UniformNumber, GaussianNumber>;

/// Makes one body every so often. Random fields draw in this order: x, y, radius, width, height, vx, vy, ax,
/// ay, mass.
struct Spawner {
  enum class Count : std::uint8_t { Spawned, Alive };
  enum class When : std::uint8_t { BeforeUpdate, AfterUpdate };

  double every = 1.0; ///< s, > 0: at most one body a frame, when floor(time/every) > the count
  Count count =
      Count::Spawned; ///< all that it ever made, or those of them that live (the lecture's list size)
  When when = When::BeforeUpdate;
  std::optional<std::int64_t> limit; ///< makes no more than this many in all
  Body prototype;                    ///< everything that is not one of the numbers below
  Number x, y;                       ///< px: a circle's centre, a rectangle's upper-left corner
  Number radius;                     ///< px; a draw below 0 becomes 0
  Number width, height;              ///< px; of rectangles; a draw below 0 becomes 0
  Number vx, vy;                     ///< px/s
  Number ax, ay;                     ///< px/s²
  Number mass = ConstantNumber{1.0}; ///< a draw that is not > 0 becomes the smallest positive mass, 1e-9
  /// Nothing: the prototype's. Draws are cut to 0 … 1, and to 0 and more.
  std::optional<Number> restitution, friction;
  std::vector<std::uint32_t> looks; ///< the n-th body takes looks[n % size]; never empty
};

/// Throws one circle at constant speed towards a destination, once for each of its moments.
struct Launch {
  struct Moment {
    std::optional<std::int64_t> frame; ///< ≥ 1: in the step to this frame, or
    double time = 0.0; ///< s: in the step to the first frame ≥ 1 whose time is not before it
    std::optional<Vec2> from{}, toward{}; ///< px: in place of the launch's own; where a pointer was
  };
  std::vector<Moment> moments;
  Anchor from;        ///< read at launch
  Anchor toward;      ///< read at launch; the body flies on past it
  double speed = 0.0; ///< px/s, ≥ 0: velocity = ((dx/len)*speed, (dy/len)*speed)
  Body prototype;     ///< radius, group, look, mass, …; position and velocity are filled in
};

/// How a frame's time becomes steps: the four forms of a main loop (G. Fiedler, "Fix Your Timestep!", 2004).
struct Stepping {
  enum class Form : std::uint8_t {
    /// One step as long as the frame: the lecture's. Results depend on the machine's frame times.
    Variable,
    /// One step of `dt`, however long the frame lasted: simulated time runs as fast as there are frames.
    Fixed,
    /// Semi-fixed: the frame's time in steps of `dt` and a shorter one for what is left.
    Clamped,
    /// As many steps of `dt` as fit into all the time that has passed; what is left over waits. The state
    /// after n
    /// steps depends on n alone. Pictures show it between the last two steps.
    Accumulator,
  };
  Form form = Form::Variable;
  double dt = 1.0 / 60.0; ///< s, > 0
};

/// Everything that a World starts from. Plain data with every name resolved to an index.
struct WorldSetup {
  Vec2 pane{640.0, 480.0}; ///< px
  Vec2 gravity{0.0, 9.8};  ///< px/s²
  std::int64_t seed = 0;   ///< of the world's java.util.Random
  Stepping stepping;
  int substeps = 1; ///< ≥ 1: each step is this many of dt/substeps
  ContactModel contactModel = ContactModel::Lecture;
  int iterations = 1; ///< ≥ 1: of ContactModel::Solver, its sweeps in each of the substeps
  std::vector<std::string> groups{"bodies"};
  Walls walls;
  std::vector<Body> bodies;          ///< in order of creation; ids are 0, 1, 2, …
  std::vector<Force> forces;         ///< summed in this order, after gravity and the body's own acceleration
  std::vector<ContactRule> contacts; ///< at most one for each pair of groups
  std::vector<Spawner> spawners;
  std::vector<Launch> launches;
};

} // namespace offstage
