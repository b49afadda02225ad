#pragma once

#include "render/draw/pixel_rows.h"

namespace offstage {

/// Mean structural similarity of two pictures of equal size: 1 equal, down to −1.
///
/// Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli: "Image Quality Assessment: From Error Visibility to
/// Structural Similarity", IEEE Trans. Image Processing 13(4), 2004: on luma (0.299 R + 0.587 G + 0.114 B,
/// over white where a pixel is not opaque), a Gaussian window of 11 × 11 px with a standard deviation of 1.5
/// px, K1 = 0.01, K2 = 0.03, L = 255, averaged over the places where the whole window lies in the picture. A
/// picture smaller than the window is extended by its edge pixels and every place counts.
double meanSsim(const PixelRows& a, const PixelRows& b, int threads);

} // namespace offstage
