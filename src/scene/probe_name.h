#pragma once

#include "src/scene/scene_builder.h"
#include "src/sim/probe.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace offstage {

/// A probe as a scene names it.
struct NamedProbe {
  std::string name; ///< "ball.speed"
  Probe probe;      ///< in the scene's units: pixels, or what [view] makes of them
  std::string unit; ///< "px/s"; of metres "m/s"; "" for a count and the frame's number
};

/// Why a text names no probe; what() fits behind "is no value of the scene: ".
class ProbeError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The probe that a name stands for; blanks around it do not count. Throws ProbeError, with the nearest valid
/// name where there is one. After all bodies and groups are known.
///
///   t, frame                      the frame's time (s) and number
///   energy, kinetic, potential,   of all bodies
///   momentum, count
///   NAME.QUANTITY                 NAME a [[body]]'s name, `#12` the body with this number in `trace`, or a
///                                 group; QUANTITY x, y, vx, vy, speed, px, py, momentum, kinetic, potential,
///                                 energy, count
///   NAME.error(OTHER)             distance of two bodies, such as a numerical and an exact one
NamedProbe findProbe(const SceneBuilder& builder, std::string_view name);

/// The same from a key's value, reported there when it is wrong.
std::optional<NamedProbe> readProbe(SceneBuilder& builder, const TomlValue& value, const std::string& what);

} // namespace offstage
