#pragma once

#include "src/sim/body.h"
#include "src/sim/event.h"

#include <span>

namespace offstage {

/// Sees each step of a World from within. It cannot change anything.
class StepObserver {
public:
  StepObserver() = default;
  StepObserver(const StepObserver&) = default;
  StepObserver& operator=(const StepObserver&) = default;
  virtual ~StepObserver() = default;

  /// The bodies are about to move by one step of an integrator, of length h (s).
  virtual void beforeMove(std::span<const Body> bodies, double h) = 0;
  /// The same bodies have moved, and are held to the walls; the contacts between them come next, but for
  /// those of the contact solver and of continuous bodies, which are done. `events` are those of the move.
  virtual void afterMove(std::span<const Body> bodies, std::span<const Event> events) = 0;
};

} // namespace offstage
