#pragma once

#include <cstdint>

namespace offstage {

/// java.util.Random, bit for bit: the 48-bit linear congruential generator that the JDK's documentation of
/// java.util.Random specifies, so that a scene with a seed draws what the lecture's Java program draws.
class Random {
public:
  /// Any 64-bit seed, as `new Random(seed)` takes it.
  explicit Random(std::int64_t seed = 0) { setSeed(seed); }

  void setSeed(std::int64_t seed);

  std::int32_t nextInt();                   ///< all 2³² values
  std::int32_t nextInt(std::int32_t bound); ///< 0 … bound−1; throws std::invalid_argument unless bound > 0
  std::int64_t nextLong();                  ///< (of a 48-bit generator: not all 2⁶⁴ values occur)
  bool nextBoolean();
  double nextDouble();   ///< [0, 1), 53 bits
  float nextFloat();     ///< [0, 1), 24 bits
  double nextGaussian(); ///< mean 0, standard deviation 1: the polar method, with StrictMath's log; keeps the
                         ///< second value

private:
  std::int32_t next(int bits);

  std::uint64_t state_ = 0;
  double storedGaussian_ = 0.0;
  bool hasStoredGaussian_ = false;
};

} // namespace offstage
