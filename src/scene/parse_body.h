#pragma once

#include "src/scene/scene_builder.h"

#include <array>
#include <cstdint>
#include <string>

namespace offstage {

inline constexpr Choice<Integrator> kIntegrators[] = {
    {"explicit-euler", Integrator::ExplicitEuler},
    {"semi-implicit-euler", Integrator::SemiImplicitEuler},
    {"verlet", Integrator::Verlet},
    {"midpoint", Integrator::Midpoint},
    {"rk4", Integrator::Rk4},
    {"exact", Integrator::Exact},
};

/// What [[body]] and [[spawn]] share: shape, group, gravity, fixed, integrator, leaving, restitution,
/// friction, continuous. The look is not read. Returns whether the shape is known, so that keys can be held
/// against it.
bool readBodyProperties(SceneBuilder& builder, const TableReader& reader, Body& body);

/// The numbers of a [[body]], in the scene's units.
struct BodyNumbers {
  std::array<double, 2> place{}; ///< a circle's centre, a rectangle's upper-left corner
  std::array<double, 2> size{};  ///< of a rectangle
  std::array<double, 2> velocity{};
  std::array<double, 2> acceleration{};
  double radius = 0.0; ///< of a circle
  double mass = 1.0;
  double restitution = 1.0;
  double friction = 0.0;
};

/// A [[body]]'s keys without its name and what follows from its numbers: those go to `numbers`, and placed()
/// brings them together.
Body readBody(SceneBuilder& builder, const TableReader& reader, BodyNumbers& numbers);

/// The body with its numbers, in the simulation's units.
Body placed(const View& view, const BodyNumbers& numbers, Body body);

/// Whether [view] has left all of the body's numbers finite.
bool isFinite(const Body& body);

/// Makes a name known that is not empty. False when it is another body's.
bool addBodyName(SceneBuilder& builder, const std::string& name, std::uint32_t id, std::uint32_t line);

/// Those of them that [[launch]] shares: group, leaving, continuous.
void readCommonProperties(SceneBuilder& builder, const TableReader& reader, Body& body);

/// Restitution and friction, which only of a [[spawn]] may be random.
void readSurface(const TableReader& reader, Body& body);
inline const Range kRestitutions = Range::between(0.0, 1.0);
inline const Range kFrictions = Range::atLeast(0.0);

/// Reports each given key that belongs to the other shape.
void rejectKeysOfOtherShape(const TableReader& reader, Shape shape,
                            std::initializer_list<std::string_view> circle,
                            std::initializer_list<std::string_view> rectangle);

} // namespace offstage
