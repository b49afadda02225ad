#include "render/draw/overlay_history.h"

#include "src/sim/force_field.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace offstage {
namespace {

constexpr double kLeastMove = 0.5; ///< px
constexpr double kRounding = 1e-9; ///< s: a frame that is due up to rounding is due

bool isFinite(const Vec2& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y());
}

std::optional<Body> findIn(std::span<const Body> bodies, std::int64_t id) {
  const auto found = std::ranges::lower_bound(bodies, id, {}, &Body::id);
  if (found == bodies.end() || found->id != id) return std::nullopt;
  return *found;
}

/// The point of a body nearest to another point.
Vec2 nearestPoint(const Body& body, const Vec2& to) {
  if (body.shape == Shape::Rectangle) return to.cwiseMax(body.position).cwiseMin(body.position + body.size);
  const Vec2 away = to - body.position;
  const double distance = length(away);
  return distance > 0.0 ? Vec2(body.position + away * (body.radius / distance)) : body.position;
}

/// Where two bodies that have touched lie against each other, after they were moved apart. A circle counts by
/// its centre; of two rectangles, the side that lies along the larger distance.
void placeContact(OverlayHistory::Contact& contact) {
  const Vec2 first = centre(contact.first, contact.first.position);
  const Vec2 second = centre(contact.second, contact.second.position);
  Vec2 from = first;
  Vec2 to = second;
  if (contact.first.shape == Shape::Rectangle) from = nearestPoint(contact.first, second);
  if (contact.second.shape == Shape::Rectangle) to = nearestPoint(contact.second, first);
  Vec2 along = to - from;
  if (contact.first.shape == Shape::Rectangle && contact.second.shape == Shape::Rectangle) {
    const Vec2 gap = (second - first).cwiseAbs() - 0.5 * (contact.first.size + contact.second.size);
    along = gap.x() > gap.y() ? Vec2(second.x() - first.x(), 0.0) : Vec2(0.0, second.y() - first.y());
  }
  const double distance = length(along);
  contact.normal = distance > 0.0 ? Vec2(along / distance) : Vec2(1.0, 0.0);
  contact.at = contact.first.shape == Shape::Circle    ? Vec2(first + contact.normal * contact.first.radius)
               : contact.second.shape == Shape::Circle ? Vec2(second - contact.normal * contact.second.radius)
                                                       : Vec2(0.5 * (from + to));
}

} // namespace

void OverlayHistory::setOverlays(const Overlays& overlays) {
  trails_ = overlays.trails;
  ghostOverlays_ = overlays.ghosts;
  ghosts_.resize(overlays.ghosts.size());
  for (const TrailOverlay& trail : overlays.trails) trailLength_ = std::max(trailLength_, trail.length);
  for (const ContactMarkOverlay& mark : overlays.contactMarks)
    contactLength_ = std::max(contactLength_, mark.duration);
}

void OverlayHistory::note(double time, std::span<const Body> bodies, std::span<const Event> events) {
  oldestShown_ = std::exchange(noted_, time);
  if (!trails_.empty()) noteTracks(time, bodies);
  if (!ghosts_.empty()) noteGhosts(time, bodies);
  if (contactLength_ > 0.0) noteContacts(time, bodies, events);
}

void OverlayHistory::noteTracks(double time, std::span<const Body> bodies) {
  for (const Body& body : bodies) {
    const bool wanted = std::ranges::any_of(trails_, [&](const auto& trail) { return trail.of.holds(body); });
    const Vec2 at = centre(body, body.position);
    if (!wanted || !isFinite(at)) continue;
    const auto [place, isNew] = tracks_.try_emplace(body.id);
    Track& track = place->second;
    track.id = body.id;
    track.group = body.group;
    track.look = body.look;
    track.head = {time, at};
    if (isNew || length(at - track.places.back().at) >= kLeastMove) track.places.push_back(track.head);
  }
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    std::deque<Place>& places = track->second.places;
    // One place older than the trail is kept: the trail begins on the way from it.
    while (places.size() > kMostPlaces || (places.size() > 1 && places[1].time < oldestShown_ - trailLength_))
      places.pop_front();
    const bool over = track->second.head.time < oldestShown_ - trailLength_;
    track = over ? tracks_.erase(track) : std::next(track);
  }
}

void OverlayHistory::noteGhosts(double time, std::span<const Body> bodies) {
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    const GhostOverlay& overlay = ghostOverlays_[i];
    GhostRow& row = ghosts_[i];
    if (time + kRounding >= row.next * overlay.every) {
      row.next = std::floor((time + kRounding) / overlay.every) + 1.0;
      for (const Body& body : bodies) {
        if (overlay.of.holds(body) && isFinite(body.position)) row.kept.push_back({time, body});
      }
    }
    while (!row.kept.empty() &&
           (row.kept.size() > kMostGhosts || row.kept.front().time < oldestShown_ - overlay.length))
      row.kept.pop_front();
  }
}

void OverlayHistory::noteContacts(double time, std::span<const Body> bodies, std::span<const Event> events) {
  std::set<std::pair<std::int64_t, std::int64_t>> now;
  for (const Event& event : events) {
    if (event.kind != EventKind::Collide && event.kind != EventKind::Hit && event.kind != EventKind::Touch)
      continue;
    const std::pair pair(event.first, event.second);
    // A pair that goes on touching, such as a ball at rest on another, is marked once.
    if (!now.insert(pair).second || touching_.contains(pair)) continue;
    auto first = findIn(bodies, event.first);
    auto second = findIn(bodies, event.second);
    if (!first) first = findIn(before_, event.first);
    if (!second) second = findIn(before_, event.second);
    if (!first || !second) continue;
    Contact contact{time, *first, *second, Vec2::Zero(), Vec2::Zero()};
    placeContact(contact);
    if (isFinite(contact.at)) contacts_.push_back(contact);
  }
  touching_ = std::move(now);
  before_.assign(bodies.begin(), bodies.end());
  while (!contacts_.empty() &&
         (contacts_.size() > kMostContacts || contacts_.front().time < oldestShown_ - contactLength_))
    contacts_.pop_front();
}

} // namespace offstage
