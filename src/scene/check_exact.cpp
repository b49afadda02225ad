#include "src/scene/scene_builder.h"
#include "src/sim/closed_form.h"

#include <fmt/core.h>

namespace offstage {
namespace {

/// Reports why a table's body cannot have Integrator::Exact: at its own integrator, or, where that is the
/// world's, at the table.
void reportProblem(SceneBuilder& builder, const TomlValue& table, std::string_view label,
                   const std::string& problem) {
  for (const TomlEntry& entry : *table.table()) {
    if (entry.key != "integrator") continue;
    builder.errors.add(entry.value,
                       fmt::format("'integrator' in {} cannot be \"exact\": {}", label, problem));
    return;
  }
  builder.errors.add(table,
                     fmt::format("{} cannot have the world's integrator \"exact\": {}", label, problem));
}

} // namespace

void checkExactBodies(SceneBuilder& builder, bool startsAreKnown) {
  const WorldSetup& world = builder.scene.world;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (body.integrator != Integrator::Exact) continue;
    const auto problem =
        startsAreKnown ? closedFormProblem(world, body) : closedFormForceProblem(world, body);
    if (problem) reportProblem(builder, *builder.bodyTables[i], "[[body]]", *problem);
  }
  for (std::size_t i = 0; i < world.spawners.size(); ++i) {
    const Body& body = world.spawners[i].prototype;
    if (body.integrator != Integrator::Exact) continue;
    const auto problem = closedFormForceProblem(world, body);
    if (problem) reportProblem(builder, *builder.spawnTables[i], "[[spawn]]", *problem);
  }
  for (std::size_t i = 0; i < world.launches.size(); ++i) {
    const Body& body = world.launches[i].prototype;
    if (body.integrator != Integrator::Exact) continue;
    const auto problem = closedFormForceProblem(world, body);
    if (problem) reportProblem(builder, *builder.launchTables[i], "[[launch]]", *problem);
  }
}

} // namespace offstage
