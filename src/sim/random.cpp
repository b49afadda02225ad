#include "src/sim/random.h"

#include "src/sim/strict_math.h"

#include <bit>
#include <stdexcept>

namespace offstage {
namespace {

// The generator's constants as the JDK's documentation of java.util.Random gives them (a linear congruential
// generator of 48 bits after Knuth, The Art of Computer Programming, volume 2, section 3.2.1).
constexpr std::uint64_t kMultiplier = 0x5DEECE66DULL;
constexpr std::uint64_t kIncrement = 0xBULL;
constexpr std::uint64_t kMask = (1ULL << 48) - 1;

} // namespace

void Random::setSeed(std::int64_t seed) {
  state_ = (std::bit_cast<std::uint64_t>(seed) ^ kMultiplier) & kMask;
  storedGaussian_ = 0.0;
  hasStoredGaussian_ = false;
}

std::int32_t Random::next(int bits) {
  state_ = (state_ * kMultiplier + kIncrement) & kMask;
  // The upper bits; the narrowing keeps the low 32 of them as two's complement, as Java's (int) cast does.
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(state_ >> (48 - bits)));
}

std::int32_t Random::nextInt() {
  return next(32);
}

std::int32_t Random::nextInt(std::int32_t bound) {
  if (bound <= 0) throw std::invalid_argument("Random::nextInt: the bound must be above 0");
  std::int32_t bits = next(31);
  const std::int32_t mask = bound - 1;
  if ((bound & mask) ==
      0) { // a power of two: take the high bits, which are the better ones of such a generator
    return static_cast<std::int32_t>((static_cast<std::int64_t>(bound) * bits) >> 31);
  }
  // Draws from the incomplete last interval of length `bound` would favour small values; they are drawn
  // again. (Java writes this test as an overflow of bits - value + mask.)
  std::int32_t value = bits % bound;
  while (static_cast<std::int64_t>(bits) - value + mask > INT32_MAX) {
    bits = next(31);
    value = bits % bound;
  }
  return value;
}

std::int64_t Random::nextLong() {
  const std::uint64_t high = static_cast<std::uint32_t>(next(32));
  const std::int64_t low = next(32); // signed: a negative low half borrows from the high one, as in Java
  return static_cast<std::int64_t>((high << 32) + static_cast<std::uint64_t>(low));
}

bool Random::nextBoolean() {
  return next(1) != 0;
}

double Random::nextDouble() {
  const std::int64_t high = next(26);
  const std::int64_t low = next(27);
  return static_cast<double>((high << 27) + low) * 0x1.0p-53;
}

float Random::nextFloat() {
  return static_cast<float>(next(24)) / 16777216.0F; // 2^24
}

double Random::nextGaussian() {
  // The polar method of Marsaglia as Knuth describes it (volume 2, section 3.4.1, algorithm P).
  if (hasStoredGaussian_) {
    hasStoredGaussian_ = false;
    return storedGaussian_;
  }
  double v1 = 0.0;
  double v2 = 0.0;
  double s = 0.0;
  do {
    v1 = 2.0 * nextDouble() - 1.0;
    v2 = 2.0 * nextDouble() - 1.0;
    s = v1 * v1 + v2 * v2;
  } while (s >= 1.0 || s == 0.0);
  const double multiplier = strict::sqrt(-2.0 * strict::log(s) / s);
  storedGaussian_ = v2 * multiplier;
  hasStoredGaussian_ = true;
  return v1 * multiplier;
}

} // namespace offstage
