#include "render/draw/picture.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

/// A length in whole pixels, at least 1. Lengths that no canvas has are cut, for the canvas to refuse.
int wholePixels(double length) {
  constexpr double kMost = 1e9;
  return static_cast<int>(std::clamp(std::floor(length + 0.5), 1.0, kMost));
}

} // namespace

Viewport Viewport::scaled(double paneWidth, double paneHeight, double scale) {
  Viewport viewport;
  viewport.width = wholePixels(paneWidth * scale);
  viewport.height = wholePixels(paneHeight * scale);
  viewport.scale = scale;
  viewport.clip = {0, 0, viewport.width, viewport.height};
  return viewport;
}

Viewport Viewport::fitted(double paneWidth, double paneHeight, int width, int height) {
  Viewport viewport;
  viewport.width = width;
  viewport.height = height;
  viewport.scale = std::min(width / paneWidth, height / paneHeight);
  // The pane starts on a whole pixel, so that what is sharp in it stays sharp.
  const int paneColumns = std::min(wholePixels(paneWidth * viewport.scale), width);
  const int paneRows = std::min(wholePixels(paneHeight * viewport.scale), height);
  const int left = (width - paneColumns) / 2;
  const int top = (height - paneRows) / 2;
  viewport.offset = Vec2(left, top);
  viewport.clip = {left, top, left + paneColumns, top + paneRows};
  return viewport;
}

} // namespace offstage
