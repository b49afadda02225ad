#include "src/scene/trace_summary.h"

#include "src/sim/contact.h"
#include "src/sim/probe.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {

namespace {

/// Processors differ in the sign of a NaN that they make.
double withoutNanSign(double value) {
  return std::isnan(value) ? std::abs(value) : value;
}

} // namespace

TraceSummary::TraceSummary(const WorldSetup& setup) : rules_(setup.contacts), ruled_(setup.groups.size(), 0) {
  for (const ContactRule& rule : rules_) ruled_.at(rule.groupA) = ruled_.at(rule.groupB) = 1;
}

void TraceSummary::add(const World& world) {
  const Snapshot snapshot = snapshotOf(world);
  const auto total = [&snapshot](Quantity quantity) {
    Probe probe;
    probe.quantity = quantity;
    return withoutNanSign(valueOf(probe, snapshot));
  };
  const Totals before = end_;
  end_ = {world.frame(),
          world.time(),
          world.bodies().size(),
          total(Quantity::Px),
          total(Quantity::Py),
          total(Quantity::Kinetic),
          total(Quantity::Potential)};
  const std::int64_t madeBefore = made_;
  countEvents(world);
  const std::int64_t made = made_ - madeBefore;
  if (!start_) {
    start_ = end_;
    unmoved_ = end_.energy();
    addDrift(end_, true);
  } else {
    const std::int64_t gone =
        static_cast<std::int64_t>(before.bodies) + made - static_cast<std::int64_t>(end_.bodies);
    gone_ += gone;
    addDrift(before, made == 0 && gone == 0);
  }
  findOverlaps(world);
}

void TraceSummary::addDrift(const Totals& before, bool sameBodies) {
  if (!sameBodies) {
    ++leftOut_;
    unmoved_ += end_.energy() - before.energy();
  }
  const double drift = std::abs(end_.energy() - unmoved_);
  if (drift > drift_.energy || std::isnan(drift)) drift_ = {drift, end_.frame};
}

void TraceSummary::countEvents(const World& world) {
  for (const Event& event : world.events()) {
    switch (event.kind) {
    case EventKind::Spawn:
    case EventKind::Fire:
      ++made_;
      break;
    case EventKind::Left:
    case EventKind::Right:
    case EventKind::Top:
    case EventKind::Bottom:
      ++walls_;
      break;
    case EventKind::Collide:
      ++collisions_;
      break;
    case EventKind::Hit:
      ++hits_;
      break;
    case EventKind::Touch:
      ++touches_;
      break;
    case EventKind::NoFire:
    case EventKind::Leave:
      break;
    }
  }
}

bool TraceSummary::collide(const Body& first, const Body& second) const {
  return std::any_of(rules_.begin(), rules_.end(), [&](const ContactRule& rule) {
    return (rule.groupA == first.group && rule.groupB == second.group) ||
           (rule.groupA == second.group && rule.groupB == first.group);
  });
}

void TraceSummary::findOverlaps(const World& world) {
  if (rules_.empty()) return;
  const std::span<const Body> bodies = world.bodies();
  members_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (ruled_[bodies[i].group] != 0) members_.push_back(static_cast<std::uint32_t>(i));
  }
  broadphase_.begin(bodies, members_);
  for (const std::uint32_t i : members_) {
    broadphase_.query(bodies[i], 0.0, near_);
    for (const std::uint32_t j : near_) {
      const Body& first = bodies[i];
      const Body& second = bodies[j];
      if (j <= i || !collide(first, second)) continue;
      const std::optional<Contact> contact = findContact(first, second);
      if (!contact) continue;
      const double depth = contact->touch - contact->distance;
      if (overlap_ && depth <= overlap_->depth) continue;
      const bool circles = first.shape == Shape::Circle && second.shape == Shape::Circle;
      overlap_ = {depth, circles ? std::min(first.radius, second.radius) : 0.0, world.frame(), first.id,
                  second.id};
    }
  }
}

std::string TraceSummary::text() const {
  const Totals start = start_.value_or(Totals{});
  std::string text = fmt::format("frames     {} … {}, {} s\n", start.frame, end_.frame, end_.time);
  text += fmt::format("bodies     {} → {}; {} came, {} went\n", start.bodies, end_.bodies, made_, gone_);
  text += fmt::format("momentum   ({}, {}) → ({}, {}) mass·px/s\n", start.px, start.py, end_.px, end_.py);
  text += fmt::format("kinetic    {} → {} mass·px²/s²\n", start.kinetic, end_.kinetic);
  text += fmt::format("potential  {} → {} mass·px²/s²\n", start.potential, end_.potential);
  text += fmt::format("energy     {} → {} mass·px²/s²\n", withoutNanSign(start.energy()),
                      withoutNanSign(end_.energy()));
  text += fmt::format("drift      at most {} mass·px²/s²", drift_.energy);
  if (start.energy() != 0.0)
    text += fmt::format(", {:.3g} of the energy at the start", drift_.energy / std::abs(start.energy()));
  text += fmt::format(", in frame {}", drift_.frame);
  if (leftOut_ > 0)
    text +=
        fmt::format("; without {} frame{} in which bodies came or went", leftOut_, leftOut_ == 1 ? "" : "s");
  text += '\n';
  text += fmt::format("contacts   {} collisions, {} hits, {} touches, {} at walls\n", collisions_, hits_,
                      touches_, walls_);
  if (!overlap_) return text + "overlap    none\n";
  text += fmt::format("overlap    at most {} px", overlap_->depth);
  if (overlap_->radius > 0.0)
    text += fmt::format(", {:.3g} of the smaller radius", overlap_->depth / overlap_->radius);
  return text +
         fmt::format(", bodies {} and {} in frame {}\n", overlap_->first, overlap_->second, overlap_->frame);
}

} // namespace offstage
