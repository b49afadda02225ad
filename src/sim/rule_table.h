#pragma once

#include "src/sim/world_setup.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// The contact rules, found by two groups. Groups that have a rule are numbered anew from 0, so that the
/// table stays small whatever the number of groups.
class RuleTable {
public:
  static constexpr std::uint32_t kNoRule = 0xffffffffU;

  RuleTable() = default;
  /// Copies the rules: at most one for a pair of groups.
  explicit RuleTable(std::vector<ContactRule> rules);

  [[nodiscard]] bool empty() const { return rules_.empty(); }
  /// The number of a group that has a rule; kNoRule when it has none.
  [[nodiscard]] std::uint32_t numberOf(std::uint32_t group) const;
  [[nodiscard]] std::size_t groups() const { return groups_.size(); } ///< that have a rule
  /// The rule of two groups, by their numbers; null when they have none.
  [[nodiscard]] const ContactRule* find(std::uint32_t first, std::uint32_t second) const {
    const std::uint32_t index = table_[first * groups_.size() + second];
    return index == kNoRule ? nullptr : &rules_[index];
  }

private:
  std::vector<ContactRule> rules_;
  std::vector<std::uint32_t> groups_; ///< that have a rule, ascending
  std::vector<std::uint32_t> table_;  ///< by two numbers: index into rules_, or kNoRule
};

} // namespace offstage
