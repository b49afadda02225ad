#pragma once

#include "src/sim/body.h"
#include "src/sim/broadphase.h"
#include "src/sim/contact.h"
#include "src/sim/event.h"
#include "src/sim/rule_table.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Finds touching pairs and applies the rule of their groups: pairs i < j in order of creation, one pass, in
/// place, so that later pairs see what earlier ones did. Pairs that are too far apart to touch are left out
/// by a grid, also while bodies are pushed apart during the pass: the result has the bits of the plain double
/// loop.
class ContactSolver {
public:
  ContactSolver() = default;
  /// Copies the rules: at most one for a pair of groups.
  explicit ContactSolver(const std::vector<ContactRule>& rules);

  [[nodiscard]] bool hasRules() const { return !rules_.empty(); }

  /// One pass over `bodies`. Sets removed[i] (as long as bodies, 0 before) for those that a rule takes away,
  /// and appends events whose frame and time are those of `stamp`.
  void solve(std::span<Body> bodies, std::span<std::uint8_t> removed, const Event& stamp,
             std::vector<Event>& events);

private:
  static constexpr std::uint32_t kGone = 0xffffffffU; ///< removed at once: touches nobody else

  void solveWithThoseBehind(std::uint32_t a, std::span<Body> bodies, std::span<std::uint8_t> removed,
                            const Event& stamp, std::vector<Event>& events);

  RuleTable rules_;

  // Of a pass; kept between steps to spare allocations.
  std::vector<std::uint32_t> candidates_; ///< index of each body that has a rule
  std::vector<std::uint32_t> groups_;     ///< by candidate: its group's number in rules_, or kGone
  Broadphase broadphase_;
  std::vector<std::uint32_t> near_;
};

} // namespace offstage
