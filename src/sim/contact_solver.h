#pragma once

#include "src/sim/body.h"
#include "src/sim/contact.h"
#include "src/sim/event.h"
#include "src/sim/world_setup.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Finds touching pairs and applies the rule of their groups: pairs i < j in order of creation, one pass, in
/// place, so that later pairs see what earlier ones did.
class ContactSolver {
public:
  ContactSolver() = default;
  /// Copies the rules: at most one for a pair of groups.
  explicit ContactSolver(const std::vector<ContactRule>& rules);

  /// One pass over `bodies`. Sets removed[i] (as long as bodies, 0 before) for those that a rule takes away,
  /// and appends events whose frame and time are those of `stamp`.
  void solve(std::span<Body> bodies, std::span<std::uint8_t> removed, const Event& stamp,
             std::vector<Event>& events);

private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  [[nodiscard]] std::uint32_t ruledIndex(std::uint32_t group) const;

  std::vector<ContactRule> rules_;
  std::vector<std::uint32_t> ruledGroups_; ///< the groups that have a rule, ascending
  std::vector<std::uint32_t> table_;       ///< by two indices into ruledGroups_: index of the rule, or kNone
  /// A body that has a rule; kept between steps only to spare allocations.
  struct Candidate {
    std::size_t body;
    std::uint32_t group; ///< index into ruledGroups_
    bool gone;           ///< removed at once: touches nobody else
  };
  std::vector<Candidate> candidates_;
};

} // namespace offstage
