#pragma once

#include "src/sim/body.h"
#include "src/sim/broadphase.h"
#include "src/sim/event.h"
#include "src/sim/impact_time.h"
#include "src/sim/rule_table.h"
#include "src/sim/tournament.h"
#include "src/sim/world_setup.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

/// Contacts of bodies that are `continuous`: along their whole path, not only where a step ends, so that a
/// fast projectile steps over nobody. Between the places where a step began and ended every body moves in a
/// straight line at constant speed; impacts are found by closed forms (timeOfImpact) and dealt with one after
/// the other, by time, at equal times by the lower, then by the higher of the two bodies' numbers of
/// creation; a wall counts as higher than any body.
///
/// At an impact both bodies are where they touch. A bounce or a slide gives them the velocities of
/// respond(), at which they go on for the rest of the step; so does a wall. Whoever is to be removed, by
/// either kind of removal, is gone from there on. A report lets both pass; it is made here only for pairs
/// that are apart again when the step ends. Pairs that overlap as the step begins are left to the ordinary
/// contacts, which follow; so is a body after kMostImpacts of them in a step.
///
/// Whom a body may meet, a grid of the places where the step ends tells: on the rest of its path nobody is
/// further from the grid's place for it than the longest rest of a path. Whoever is thrown off its path gets
/// another place. So an impact costs what stands around it, however many there are elsewhere.
class SweptContacts {
public:
  static constexpr int kMostImpacts = 64;

  SweptContacts() = default;
  /// Copies what it needs of the setup.
  explicit SweptContacts(const WorldSetup& setup);

  /// Before a step: keeps where all bodies are. False, and nothing kept, when none is continuous.
  bool begin(std::span<const Body> bodies);

  /// After bodies have moved for `h` seconds, continuous ones not yet held to the walls: goes through their
  /// paths. Sets removed[i] for those that a rule takes away and appends events.
  void solve(std::span<Body> bodies, double h, std::span<std::uint8_t> removed, const Event& stamp,
             std::vector<Event>& events);

private:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  /// A body's motion from `since` on.
  struct Path {
    Vec2 from = Vec2::Zero();     ///< px: Body::position
    Vec2 velocity = Vec2::Zero(); ///< px/s
    double since = 0.0;           ///< s, from the step's start
  };
  /// The next thing that a continuous body runs into.
  struct Next {
    double time = std::numeric_limits<double>::infinity(); ///< s, from the step's start
    std::uint32_t first = kNobody, second = kNobody;       ///< the pair, the lower index first; of a wall
                                                           ///< second = number of bodies + side
    Vec2 normal = Vec2::Zero();
    [[nodiscard]] bool isBefore(const Next& other) const;
  };

  [[nodiscard]] Body at(std::span<const Body> bodies, std::uint32_t index, double time) const;
  [[nodiscard]] const ContactRule* ruleOf(const Body& first, const Body& second) const;
  /// False only for two that stay apart for the rest of the step.
  [[nodiscard]] bool mayMeet(const Body& first, const Path& path, const Body& second, const Path& other,
                             double now) const;
  /// Fills `found` with all that may meet a body on the rest of its path, ascending.
  void findNear(std::span<const Body> bodies, std::uint32_t index, double now,
                std::vector<std::uint32_t>& found) const;
  void beginPaths(std::span<const Body> bodies, double h);
  /// Whoever has just met somebody goes on along another path: everybody's place and neighbours after it.
  void takeNewPath(std::span<const Body> bodies, std::uint32_t index, double now);
  /// Notes the fast ones among `who`, whose next impact has to be looked for again.
  void concern(std::span<const std::uint32_t> who);
  void findNext(std::span<const Body> bodies, std::size_t fast, double now);
  void considerBody(std::span<const Body> bodies, std::uint32_t a, std::uint32_t b, double now,
                    Next& next) const;
  void considerWalls(std::span<const Body> bodies, std::uint32_t index, double now, Next& next) const;
  void meet(std::span<Body> bodies, const Next& impact, std::span<std::uint8_t> removed, const Event& stamp,
            std::vector<Event>& events);
  void hitWall(std::span<Body> bodies, const Next& impact, const Event& stamp, std::vector<Event>& events);

  RuleTable rules_;
  Walls walls_;
  Vec2 pane_ = Vec2::Zero();
  double length_ = 0.0; ///< s: of the step

  // Of a step, by index of the body; kept to spare allocations.
  std::vector<Path> paths_;
  std::vector<std::uint8_t> gone_;
  std::vector<int> impacts_;
  std::vector<std::uint32_t> fast_;              ///< the continuous bodies
  std::vector<std::uint32_t> numbers_;           ///< by body: its index in fast_, or kNobody
  std::vector<Next> nexts_;                      ///< by index into fast_
  std::vector<std::vector<std::uint32_t>> near_; ///< by index into fast_: whom it may meet, ascending
  std::vector<std::uint32_t> concerned_;         ///< indices into fast_
  std::vector<std::uint32_t> around_;            ///< whom a body may meet
  Tournament soonest_;                           ///< among nexts_
  double farthest_ = 0.0;                        ///< px, per axis: of all, in a whole step as fast as now
  std::vector<Next> passed_;                     ///< pairs that have met and go on through each other
  std::vector<std::uint32_t> everybody_;
  Broadphase broadphase_; ///< of where the step ends
};

} // namespace offstage
