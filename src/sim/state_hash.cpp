#include "src/sim/state_hash.h"

#include <bit>
#include <cmath>

namespace offstage {
namespace {

// FNV-1a, 64 bits: Fowler, Noll, Vo and Eastlake, "The FNV Non-Cryptographic Hash Algorithm" (IETF draft).
constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325ULL;
constexpr std::uint64_t kPrime = 0x100000001b3ULL;

std::uint64_t addBytes(std::uint64_t hash, std::uint64_t value) {
  for (int byte = 0; byte < 8; ++byte) {
    hash = (hash ^ ((value >> (8 * byte)) & 0xffU)) * kPrime;
  }
  return hash;
}

std::uint64_t addDouble(std::uint64_t hash, double value) {
  // Processors differ in the sign and payload of the NaN that an operation makes, so all NaNs count as one.
  constexpr std::uint64_t kNan = 0x7ff8000000000000ULL;
  return addBytes(hash, std::isnan(value) ? kNan : std::bit_cast<std::uint64_t>(value));
}

} // namespace

StateHash::StateHash(double time) : hash_(addDouble(kOffsetBasis, time)) {}

void StateHash::add(std::uint32_t id, Shape shape, const Vec2& position, const Vec2& velocity, double radius,
                    const Vec2& size) {
  hash_ = addBytes(hash_, id);
  hash_ = addBytes(hash_, shape == Shape::Circle ? 0 : 1);
  for (const double value :
       {position.x(), position.y(), velocity.x(), velocity.y(), radius, size.x(), size.y()}) {
    hash_ = addDouble(hash_, value);
  }
}

} // namespace offstage
