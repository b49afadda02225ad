#pragma once

#include "src/scene/overlay.h"
#include "src/sim/body.h"
#include "src/sim/event.h"

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace offstage {

/// What overlays show of the past. It is told of every frame in order, wherever drawing begins, so that the
/// same frame shows the same past in every segment, chunk and still. In slow motion a picture may show a
/// moment between the last two frames: what belongs to the last one is known then, but not yet to be seen.
class OverlayHistory {
public:
  struct Place {
    double time; ///< s
    Vec2 at;     ///< px: a body's centre
  };
  /// Where a body has been, at most once every half px; the last place is its present or final one.
  struct Track {
    std::uint32_t id = 0;
    std::uint32_t group = 0;
    std::uint32_t look = 0;
    std::deque<Place> places{};
    Place head{};
  };
  struct Ghost {
    double time; ///< s
    Body body;
  };
  struct Contact {
    double time; ///< s: of the frame that shows it first
    Body first, second;
    Vec2 at;     ///< px
    Vec2 normal; ///< of length 1, from the first body to the second
  };

  explicit OverlayHistory(const Overlays& overlays) { setOverlays(overlays); }
  /// Further overlays begin with what is noted from now on; those that were there, in the same order, go on.
  void setOverlays(const Overlays& overlays);

  /// The present frame: its time (s), its living bodies, and what happened in the step to it.
  void note(double time, std::span<const Body> bodies, std::span<const Event> events);

  /// By body, those that are gone included while their trail is still seen.
  [[nodiscard]] const std::map<std::uint32_t, Track>& tracks() const { return tracks_; }
  /// Of one [[ghost]] by its number in Overlays::ghosts, oldest first.
  [[nodiscard]] const std::deque<Ghost>& ghosts(std::size_t index) const { return ghosts_[index].kept; }
  [[nodiscard]] const std::deque<Contact>& contacts() const { return contacts_; } ///< oldest first

  /// More places a trail, and more ghosts, are not kept; the oldest go.
  static constexpr std::size_t kMostPlaces = 20000;
  static constexpr std::size_t kMostGhosts = 20000;
  static constexpr std::size_t kMostContacts = 2000;

private:
  struct GhostRow {
    double next = 0.0; ///< number of the next moment to keep: it is at next·every
    std::deque<Ghost> kept{};
  };

  void noteTracks(double time, std::span<const Body> bodies);
  void noteGhosts(double time, std::span<const Body> bodies);
  void noteContacts(double time, std::span<const Body> bodies, std::span<const Event> events);

  double noted_ = 0.0;       ///< s: the last frame's time
  double oldestShown_ = 0.0; ///< s: the time of the frame before, from which on moments may be shown
  std::vector<TrailOverlay> trails_;
  std::vector<GhostOverlay> ghostOverlays_;
  double trailLength_ = 0.0;   ///< s: the longest trail's
  double contactLength_ = 0.0; ///< s: the longest mark's
  std::map<std::uint32_t, Track> tracks_;
  std::vector<GhostRow> ghosts_;
  std::deque<Contact> contacts_;
  std::vector<Body> before_; ///< the frame before, for bodies that a contact takes away
  std::set<std::pair<std::int64_t, std::int64_t>> touching_; ///< pairs that touched in the last step
};

} // namespace offstage
