#include "tests/support/test_frames.h"

#include "src/sim/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace offstage::test {

namespace {

struct Circle {
  double x, y, vx, vy, radius; ///< as fractions of the frame's height; a frame
  std::array<std::uint8_t, 3> color;
};

constexpr std::array<Circle, 5> kCircles{{{0.20, 0.30, 0.010, 0.004, 0.10, {220, 30, 30}},
                                          {0.90, 0.70, -0.006, -0.005, 0.15, {20, 60, 200}},
                                          {0.50, 0.50, 0.003, -0.009, 0.07, {30, 160, 60}},
                                          {1.10, 0.20, -0.012, 0.007, 0.05, {0, 0, 0}},
                                          {0.70, 0.90, 0.008, -0.011, 0.12, {250, 200, 40}}}};

void drawCircle(Frame& frame, double x, double y, double radius, const std::array<std::uint8_t, 3>& color) {
  for (int row = 0; row < frame.height; ++row) {
    for (int column = 0; column < frame.width; ++column) {
      const double coverage =
          std::clamp(radius + 0.5 - std::hypot(column + 0.5 - x, row + 0.5 - y), 0.0, 1.0);
      std::uint8_t* pixel = &frame.rgba[pixelIndex(row, frame.width, column) * 4];
      for (std::size_t c = 0; c < 3; ++c) {
        pixel[c] = static_cast<std::uint8_t>(std::lround(pixel[c] + (color[c] - pixel[c]) * coverage));
      }
    }
  }
}

} // namespace

Frame flatFrame(int width, int height, std::array<std::uint8_t, 4> rgba) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  for (std::size_t i = 0; i < frame.rgba.size(); ++i) frame.rgba[i] = rgba[i % 4];
  return frame;
}

Frame noiseFrame(int width, int height, std::uint32_t seed) {
  Frame frame = flatFrame(width, height, {});
  for (std::uint8_t& byte : frame.rgba) {
    seed = seed * 1664525U + 1013904223U; // Numerical Recipes, section 7.1
    byte = static_cast<std::uint8_t>(seed >> 24U);
  }
  return frame;
}

Frame lectureFrame(int width, int height, int number) {
  Frame frame = flatFrame(width, height, {255, 255, 255, 255});
  for (const Circle& circle : kCircles) {
    drawCircle(frame, (circle.x + circle.vx * number) * height, (circle.y + circle.vy * number) * height,
               circle.radius * height, circle.color);
  }
  return frame;
}

FrameTiming fixedTiming(std::int64_t index, double fps) {
  const auto at = [fps](std::int64_t frame) {
    return static_cast<std::int64_t>(std::llround(static_cast<double>(frame) / fps * 1e9));
  };
  return {index, at(index), at(index + 1)};
}

SinkFormat formatOf(int width, int height, double fps) {
  SinkFormat format;
  format.width = width;
  format.height = height;
  format.fps = fps;
  return format;
}

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return std::to_string(static_cast<int>(error.code())) + ": " + error.what();
  }
  return "no error";
}

} // namespace offstage::test
