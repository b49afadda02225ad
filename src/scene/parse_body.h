#pragma once

#include "src/scene/scene_builder.h"

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

/// Those of them that [[launch]] shares: group, leaving, restitution, friction, continuous.
void readCommonProperties(SceneBuilder& builder, const TableReader& reader, Body& body);

/// Reports each given key that belongs to the other shape.
void rejectKeysOfOtherShape(const TableReader& reader, Shape shape,
                            std::initializer_list<std::string_view> circle,
                            std::initializer_list<std::string_view> rectangle);

} // namespace offstage
