#pragma once

#include "render/compare/bit_plane.h"
#include "render/compare/comparison.h"
#include "render/draw/pixel_rows.h"

#include <array>
#include <cstdint>
#include <vector>

namespace offstage {

/// Sums over the pixels compared, in units of the channels' own (of 255 or 65535).
struct DifferenceSums {
  std::int64_t unequal = 0;       ///< px
  std::int64_t colorSum = 0;      ///< Σ|d| over red, green, blue
  std::int64_t alphaSum = 0;      ///< Σ|d| of alpha
  std::uint64_t colorSquares = 0; ///< Σd²
  std::uint64_t alphaSquares = 0;
  int largest = 0; ///< |d| of any channel
};

/// What one look at all pixels finds.
struct DifferencePass {
  double unit = 1.0; ///< levels of 255 that 1 of the channels' own units is
  DifferenceSums sums;
  BitPlane differing; ///< beyond the limit and not forgiven
  BitPlane forgiven;  ///< empty unless antialiasing is forgiven
  std::int64_t forgivenCount = 0;
  std::vector<PixelPair> worst;         ///< up to ten differing ones
  std::vector<PixelPair> worstForgiven; ///< up to one
};

struct DifferenceRules {
  double maxChannel = 0.0; ///< levels: a larger difference of a channel makes a pixel differ
  bool strictAlpha = false;
  bool forgiveAntialiasing = false;
  const BitPlane* ignored = nullptr; ///< pixels not looked at; null or empty: none
  int threads = 1;
};

/// Looks at all pixels of two pictures of equal size. When either has 16 bits a channel, both are compared in
/// 16. Under alpha 0 colours are hidden: unless strict, two such pixels are equal, and one such pixel differs
/// from another in its alpha only.
DifferencePass findDifferences(const PixelRows& expected, const PixelRows& actual,
                               const DifferenceRules& rules);

} // namespace offstage
