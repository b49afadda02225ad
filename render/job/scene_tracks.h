#pragma once

#include "render/output/tracks.h"
#include "src/scene/film.h"
#include "src/scene/timeline.h"
#include "src/sim/world.h"

#include <vector>

namespace offstage {

/// Something that can be heard.
struct ContactMoment {
  double time = 0.0;  ///< s of the world's time
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
/// fast. Events are stamped with the frame that shows them, so the moment is worked out from how things were
/// before the step: the gap between the two divided by the mean of their closing speeds then and at the
/// contact, which is exact for uniform acceleration, and within the step in any case. It so does not depend
/// on the number of substeps. `before`: the bodies before the step, at `timeBefore` (s of the world's time).
std::vector<ContactMoment> contactsOf(const World& after, std::span<const Body> before, double timeBefore);

/// When (s of the clock's time) the pictures show what happened at `time` of the world's own, in the step to
/// `tick`. Most main loops keep the world's time equal to the clock's. One of fixed steps has its own pace,
/// and with an accumulator the pictures lag behind by one step (World::shown()).
double shownAt(const World& after, double timeBefore, const Tick& tick, double time);

} // namespace offstage
