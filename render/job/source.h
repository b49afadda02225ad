#pragma once

#include "render/draw/picture.h"
#include "render/output/tracks.h"
#include "src/scene/film.h"
#include "src/sim/clock.h"

#include <cstdint>
#include <string>

namespace offstage {

/// Anything that can be stepped and drawn frame by frame: a scene's world, or an exercise written in C++.
class Source {
public:
  virtual ~Source() = default;
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  [[nodiscard]] virtual const Clock& clock() const = 0;
  [[nodiscard]] virtual const std::string& title() const = 0;
  [[nodiscard]] virtual std::int64_t frame() const = 0; ///< the present frame, from 0
  virtual void step() = 0;                              ///< to the next frame; frame() < clock().steps()
  virtual void draw(Picture& picture) const = 0;        ///< the present frame, or what show() has chosen
  [[nodiscard]] virtual std::uint64_t stateHash() const = 0;
  /// A hash of all that its frames are made from, but for the options of the command line and the program
  /// itself: the same for two sources that show the same. Asked for at frame 0.
  [[nodiscard]] virtual std::uint64_t fingerprint() const = 0;

  /// What is shown when. Null: each frame of the clock in its time.
  [[nodiscard]] virtual const Film* film() const { return nullptr; }
  /// Steps to what a frame of the video shows, which draw() draws from then on. Shots only go forward. Of a
  /// moment between two frames the source then stands at the later one.
  virtual void show(const Shot& shot) {
    while (frame() < shot.moment.frame) step();
  }
  /// The state hash of the frame that the shot names (of a moment between two frames, the earlier).
  [[nodiscard]] virtual std::uint64_t shownStateHash() const { return stateHash(); }
  /// Whether draw() depends on more of a shot than its moment.
  [[nodiscard]] virtual bool followsVideoTime() const { return false; }
  /// Whether tracks() may hold captions.
  [[nodiscard]] virtual bool hasCaptions() const { return false; }
  /// What stands beside the pictures from one time of the video to another (s). May take as long as a
  /// simulation.
  [[nodiscard]] virtual VideoTracks tracks(double /*from*/, double /*to*/) const { return {}; }
};

} // namespace offstage
