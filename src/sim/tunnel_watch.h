#pragma once

#include "src/sim/body.h"
#include "src/sim/broadphase.h"
#include "src/sim/event.h"
#include "src/sim/rule_table.h"
#include "src/sim/warning.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

/// Finds bodies that go through each other between two steps, and through the pane's edges.
///
/// Two bodies of groups with a rule have crossed when they are apart before the move and after it, and on
/// the straight line between overlap halfway through by at least a quarter of how deep they could, so that a
/// graze does not count. A move that short of 1.3 times the narrower halves of both cannot be one. Bodies
/// that met something in the same move are left out, for their way was not straight, and continuous ones,
/// whose whole way is looked at anyhow.
///
/// An edge has been crossed by a body that is wholly behind a closed one in two frames in a row (one that
/// others push out is usually back in the next), and was not made there.
class TunnelWatch {
public:
  TunnelWatch() = default;
  /// Copies what it needs of the setup.
  explicit TunnelWatch(const WorldSetup& setup);

  /// Before a move, for which an integrator takes steps of `h` (s): keeps where the bodies are. Does nothing
  /// when no rule is there.
  void begin(std::span<const Body> bodies, double h);
  /// After it: the first pair that crossed.
  std::optional<Warning> findPair(std::span<const Body> bodies, std::span<const Event> events);

  /// After each frame, and before the first: the first body that has crossed an edge.
  std::optional<Warning> findEdge(std::span<const Body> bodies);

private:
  struct Move {
    Vec2 way = Vec2::Zero(); ///< px
    std::uint32_t index = 0;
  };
  [[nodiscard]] bool takesPart(const Body& body) const;
  [[nodiscard]] bool haveRule(const Body& first, const Body& second) const;
  [[nodiscard]] std::optional<Warning> crossing(std::span<const Body> bodies, const Move& move,
                                                std::uint32_t other) const;
  [[nodiscard]] bool isInside(const Body& body) const;
  [[nodiscard]] std::optional<Side> edgePassed(const Body& body) const;

  RuleTable rules_;
  std::vector<std::uint8_t> ruled_; ///< by group: 1 when it has a rule
  Walls walls_;
  Vec2 pane_ = Vec2::Zero();
  bool closed_ = false; ///< some edge is
  int parts_ = 1;       ///< steps of an integrator in a move

  // Of a move; kept to spare allocations.
  double length_ = 0.0;      ///< s
  std::vector<Vec2> starts_; ///< by index: Body::position
  std::vector<Move> fast_;
  std::vector<std::uint8_t> met_; ///< by index: 1 when it met something in the move
  std::vector<std::uint32_t> members_, near_;
  Broadphase broadphase_;

  struct Behind {
    std::uint32_t id = 0;
    bool meant = false; ///< it was made there
  };
  std::vector<Behind> behind_, nowBehind_; ///< by id: who is behind a closed edge, in the last frame and now
  std::int64_t newest_ = -1;               ///< id of the newest body of the last frame
};

} // namespace offstage
