#include "src/sim/contact_solver.h"

#include <algorithm>

namespace offstage {

ContactSolver::ContactSolver(const std::vector<ContactRule>& rules) : rules_(rules) {
  for (const ContactRule& rule : rules_) {
    ruledGroups_.push_back(rule.groupA);
    ruledGroups_.push_back(rule.groupB);
  }
  std::sort(ruledGroups_.begin(), ruledGroups_.end());
  ruledGroups_.erase(std::unique(ruledGroups_.begin(), ruledGroups_.end()), ruledGroups_.end());
  const std::size_t size = ruledGroups_.size();
  table_.assign(size * size, kNone);
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const std::size_t a = ruledIndex(rules_[i].groupA);
    const std::size_t b = ruledIndex(rules_[i].groupB);
    table_[a * size + b] = static_cast<std::uint32_t>(i);
    table_[b * size + a] = static_cast<std::uint32_t>(i);
  }
}

std::uint32_t ContactSolver::ruledIndex(std::uint32_t group) const {
  const auto found = std::lower_bound(ruledGroups_.begin(), ruledGroups_.end(), group);
  if (found == ruledGroups_.end() || *found != group) return kNone;
  return static_cast<std::uint32_t>(found - ruledGroups_.begin());
}

void ContactSolver::solve(std::span<Body> bodies, std::span<std::uint8_t> removed, const Event& stamp,
                          std::vector<Event>& events) {
  if (rules_.empty()) return;
  candidates_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::uint32_t group = ruledIndex(bodies[i].group);
    if (group != kNone) candidates_.push_back({i, group, false});
  }

  const auto report = [&](EventKind kind, const Body& first, const Body& second, double p, double q) {
    Event event = stamp;
    event.kind = kind;
    event.first = first.id;
    event.second = second.id;
    event.p = p;
    event.q = q;
    events.push_back(event);
  };
  for (std::size_t a = 0; a < candidates_.size(); ++a) {
    for (std::size_t b = a + 1; b < candidates_.size() && !candidates_[a].gone; ++b) {
      if (candidates_[b].gone) continue;
      const std::uint32_t index = table_[candidates_[a].group * ruledGroups_.size() + candidates_[b].group];
      if (index == kNone) continue;
      const ContactRule& rule = rules_[index];
      Body& first = bodies[candidates_[a].body];
      Body& second = bodies[candidates_[b].body];
      const std::optional<Contact> contact = findContact(first, second);
      if (!contact) continue;

      switch (rule.response) {
      case Response::Bounce:
      case Response::Slide:
        if (responds(rule, *contact, first, second)) {
          report(EventKind::Collide, first, second, contact->distance, closingSpeed(*contact, first, second));
          respond(rule, *contact, first, second);
        }
        if (rule.separate) separate(*contact, first, second);
        break;
      case Response::RemoveImmediately:
        candidates_[a].gone = candidates_[b].gone = true;
        [[fallthrough]];
      case Response::Remove:
        report(EventKind::Hit, first, second, contact->distance, contact->touch);
        removed[candidates_[a].body] = removed[candidates_[b].body] = 1;
        break;
      case Response::Report:
        report(EventKind::Touch, first, second, contact->distance, contact->touch);
        break;
      }
    }
  }
}

} // namespace offstage
