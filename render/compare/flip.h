#pragma once

#include "render/compare/comparison.h"
#include "render/draw/pixel_rows.h"

#include <vector>

namespace offstage {

// LDR-FLIP as version 1.6 of NVIDIA's reference tool computes it, at its defaults: 67 pixels a degree (a
// screen 0.7 m wide with 3840 px, seen from 0.7 m).
//
// P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild: "FLIP: A Difference
// Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. Filters are
// separated as in J. Nilsson, P. Andersson: "Separated convolutions" (the tool's repository, since 1.2).
// Alpha is not looked at, and of 16 bits a channel the upper 8 are taken, as the tool loads its pictures.

/// The error of every pixel, 0 equal … 1, rows top-down.
struct FlipMap {
  int width = 0;
  int height = 0;
  std::vector<float> errors;
};

/// Compares two pictures of equal size. Parts without an unequal pixel nearby are skipped: their error is 0.
FlipMap flipMap(const PixelRows& reference, const PixelRows& test, int threads);

/// Mean, max and the quartiles weighted by the error: the smallest error up to which the sorted errors add up
/// to more than a quarter, half, three quarters of their sum.
FlipSummary poolFlip(const FlipMap& map);

} // namespace offstage
