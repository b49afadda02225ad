#pragma once

/// Everything that an exercise written in C++ needs:
///
///     struct Bounce : offstage::Exercise { void start(offstage::Stage&) override; void
///     frame(offstage::Stage&, double dt) override; }; int main(int argc, char** argv) { return
///     offstage::run<Bounce>(argc, argv); }

#include "render/stage/exercise.h"
#include "render/stage/game_object.h"
#include "render/stage/input.h"
#include "render/stage/node.h"
#include "render/stage/stage.h"
#include "render/stage/text.h"
#include "src/scene/color.h"
#include "src/scene/look.h"
#include "src/scene/text_look.h"
#include "src/sim/error.h"
#include "src/sim/random.h"
#include "src/sim/vec.h"
