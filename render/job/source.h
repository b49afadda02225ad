#pragma once

#include "render/draw/picture.h"
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
  virtual void draw(Picture& picture) const = 0;        ///< the present frame
  [[nodiscard]] virtual std::uint64_t stateHash() const = 0;
  /// A hash of all that its frames are made from, but for the options of the command line and the program
  /// itself: the same for two sources that show the same. Asked for at frame 0.
  [[nodiscard]] virtual std::uint64_t fingerprint() const = 0;
};

} // namespace offstage
