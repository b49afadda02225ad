#pragma once

#include "src/sim/body.h"

#include <cstdint>

namespace offstage {

/// The 64-bit state hash of a frame: FNV-1a (Fowler, Noll, Vo; offset basis 0xcbf29ce484222325, prime
/// 0x100000001b3) over the little-endian bytes of, for the frame, its time, and for every living body in
/// order of creation, id (as 64-bit), shape (0 circle, 1 rectangle, as 64-bit), x, y, vx, vy, radius, width,
/// height (as IEEE doubles). It holds what `trace` shows, so a scene and a C++ program that compute the same
/// motion have the same hash.
class StateHash {
public:
  explicit StateHash(double time);
  void add(std::uint32_t id, Shape shape, const Vec2& position, const Vec2& velocity, double radius,
           const Vec2& size);
  [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
  std::uint64_t hash_;
};

} // namespace offstage
