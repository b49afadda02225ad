#pragma once

#include "render/output/tracks.h"
#include "src/scene/film.h"
#include "src/scene/timeline.h"
#include "src/sim/world.h"

#include <vector>

namespace offstage {

/// Something that can be heard.
struct ContactMoment {
  double time = 0.0;  ///< s of simulated time
  double speed = 0.0; ///< px/s at which the two came together
};

/// Whether what stands beside the pictures depends on what happens in the simulation.
bool needsEvents(const Timeline& timeline);

/// How long (s) each narration is: see makeFilm. Reads the files. Throws SceneError, located at the scene's
/// key, for one that is no sound.
std::vector<double> narrationLengths(const Timeline& timeline);

/// What stands beside the pictures of the video from one moment of it to another (s). `start`: the world at
/// frame 0; null where nothing is simulated. Simulates all of it when needsEvents().
VideoTracks sceneTracks(const Timeline& timeline, const Film& film, const World* start, double from,
                        double to);

/// When two bodies, or a body and an edge of the pane, came together in the step that led to `after`, and how
/// fast: events are stamped with the frame that shows them, and the contact itself was before that by the
/// overlap divided by the closing speed, at most the step's length. `before`: the bodies before the step.
std::vector<ContactMoment> contactsOf(const World& after, std::span<const Body> before, double dt);

} // namespace offstage
