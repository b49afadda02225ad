#include "src/sim/contact_solver.h"

#include <algorithm>

namespace offstage {

ContactSolver::ContactSolver(const std::vector<ContactRule>& rules) : rules_(rules) {}

void ContactSolver::solve(std::span<Body> bodies, std::span<std::uint8_t> removed, const Event& stamp,
                          std::vector<Event>& events) {
  if (rules_.empty()) return;
  candidates_.clear();
  groups_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::uint32_t group = rules_.numberOf(bodies[i].group);
    if (group == RuleTable::kNoRule) continue;
    candidates_.push_back(static_cast<std::uint32_t>(i));
    groups_.push_back(group);
  }
  broadphase_.begin(bodies, candidates_);
  for (std::uint32_t a = 0; a < candidates_.size(); ++a) {
    if (groups_[a] == kGone) continue;
    broadphase_.remove(a); // what is left are those behind it
    solveWithThoseBehind(a, bodies, removed, stamp, events);
  }
}

void ContactSolver::solveWithThoseBehind(std::uint32_t a, std::span<Body> bodies,
                                         std::span<std::uint8_t> removed, const Event& stamp,
                                         std::vector<Event>& events) {
  const auto report = [&](EventKind kind, const Body& first, const Body& second, double p, double q) {
    Event event = stamp;
    event.kind = kind;
    event.first = first.id;
    event.second = second.id;
    event.p = p;
    event.q = q;
    events.push_back(event);
  };
  Body& first = bodies[candidates_[a]];
  Vec2 queried = first.position;
  double margin = 0.0;
  broadphase_.query(first, margin, near_);
  for (auto next = near_.begin(); next != near_.end();) {
    const std::uint32_t b = *next;
    ++next;
    const ContactRule* found = rules_.find(groups_[a], groups_[b]);
    if (found == nullptr) continue;
    const ContactRule& rule = *found;
    Body& second = bodies[candidates_[b]];
    const std::optional<Contact> contact = findContact(first, second);
    if (!contact) continue;

    switch (rule.response) {
    case Response::Bounce:
    case Response::Slide:
      if (responds(rule, *contact, first, second)) {
        report(EventKind::Collide, first, second, contact->distance, closingSpeed(*contact, first, second));
        respond(rule, *contact, first, second);
      }
      if (!rule.separate) break;
      separate(*contact, first, second);
      if (!second.fixed) broadphase_.move(b, second);
      // From its new place it may reach others; those before b have had their turn. The margin spares asking
      // anew at each of many small pushes.
      if (const double moved = (first.position - queried).cwiseAbs().maxCoeff(); !(moved <= margin)) {
        queried = first.position;
        margin = 2.0 * moved;
        broadphase_.query(first, margin, near_);
        next = std::upper_bound(near_.begin(), near_.end(), b);
      }
      break;
    case Response::RemoveImmediately:
      groups_[a] = groups_[b] = kGone;
      broadphase_.remove(b);
      [[fallthrough]];
    case Response::Remove:
      report(EventKind::Hit, first, second, contact->distance, contact->touch);
      removed[candidates_[a]] = removed[candidates_[b]] = 1;
      if (rule.response == Response::RemoveImmediately) return;
      break;
    case Response::Report:
      report(EventKind::Touch, first, second, contact->distance, contact->touch);
      break;
    }
  }
}

} // namespace offstage
