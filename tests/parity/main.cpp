// trace SCENE DTLOG: `offstage trace SCENE --dt DTLOG` without the rest of the program.
#include "src/scene/scene.h"
#include "src/scene/trace.h"
#include "src/sim/world.h"

#include <cstdio>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: trace SCENE DTLOG\n", stderr);
    return 2;
  }
  try {
    offstage::SceneOverrides overrides;
    overrides.dtLog = argv[2];
    const offstage::Scene scene = offstage::loadScene(argv[1], overrides);
    offstage::World world(scene.world);
    offstage::TraceWriter writer(std::cout, offstage::TraceFormat::Csv, scene.world.groups);
    writer.write(world);
    while (world.frame() < scene.clock.steps()) {
      world.step(scene.clock.tick(world.frame() + 1));
      writer.write(world);
    }
  } catch (const offstage::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
