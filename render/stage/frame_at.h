#pragma once

#include "render/raster/frame.h"
#include "render/stage/exercise.h"

#include <filesystem>
#include <memory>

namespace offstage {

/// The frame on show at `at` seconds of a scene file, as `offstage still` draws it. Throws Error.
Frame sceneFrame(const std::filesystem::path& scene, double at);

/// The same of an exercise written in C++.
Frame exerciseFrame(std::unique_ptr<Exercise> exercise, double at);

template <class T>
Frame exerciseFrame(double at) {
  return exerciseFrame(std::make_unique<T>(), at);
}

} // namespace offstage
