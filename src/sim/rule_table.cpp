#include "src/sim/rule_table.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace offstage {

RuleTable::RuleTable(std::vector<ContactRule> rules) : rules_(std::move(rules)) {
  for (const ContactRule& rule : rules_) {
    groups_.push_back(rule.groupA);
    groups_.push_back(rule.groupB);
  }
  std::sort(groups_.begin(), groups_.end());
  groups_.erase(std::unique(groups_.begin(), groups_.end()), groups_.end());
  const std::size_t size = groups_.size();
  table_.assign(size * size, kNoRule);
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const std::size_t a = numberOf(rules_[i].groupA);
    const std::size_t b = numberOf(rules_[i].groupB);
    table_[a * size + b] = static_cast<std::uint32_t>(i);
    table_[b * size + a] = static_cast<std::uint32_t>(i);
  }
}

std::uint32_t RuleTable::numberOf(std::uint32_t group) const {
  const auto found = std::lower_bound(groups_.begin(), groups_.end(), group);
  if (found == groups_.end() || *found != group) return kNoRule;
  return static_cast<std::uint32_t>(found - groups_.begin());
}

} // namespace offstage
