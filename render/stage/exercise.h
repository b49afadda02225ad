#pragma once

#include "render/stage/stage.h"

#include <functional>
#include <memory>

namespace offstage {

/// An exercise written in C++, in the shape of the lecture's: start() builds the first picture, frame() is
/// the AnimationTimer's handle(). What it draws depends on nothing but dt, stage.time() and stage.random() as
/// long as it reads no clock and no other randomness, so every render of it is the same.
class Exercise {
public:
  virtual ~Exercise() = default;
  Exercise() = default;
  Exercise(const Exercise&) = delete;
  Exercise& operator=(const Exercise&) = delete;

  /// Read once, before start().
  [[nodiscard]] virtual Settings settings() const { return {}; }
  /// Frame 0: add what is there at the beginning.
  virtual void start(Stage& stage) = 0;
  /// Each further frame; dt in s since the frame before.
  virtual void frame(Stage& stage, double dt) = 0;
};

/// The whole of a program's main: the options of `offstage render` but for the scene, and its exit status.
int runExercise(const std::function<std::unique_ptr<Exercise>()>& make, int argc, const char* const* argv);

template <class T>
int run(int argc, char** argv) {
  return runExercise([] { return std::make_unique<T>(); }, argc, argv);
}

} // namespace offstage
