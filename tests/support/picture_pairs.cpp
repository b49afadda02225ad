#include "tests/support/picture_pairs.h"

#include <algorithm>
#include <array>

namespace offstage::test {
namespace {

class Generator {
public:
  explicit Generator(std::uint32_t seed) : state_(seed) {}
  int operator()(int below) {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<int>((state_ >> 16U) % static_cast<std::uint32_t>(below));
  }

private:
  std::uint32_t state_;
};

/// Places and radius in quarters of a pixel.
struct QuarterDisc {
  int x = 0, y = 0, r = 0;
  std::array<int, 4> color{};
};

void drawDisc(Frame& picture, const QuarterDisc& disc) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      int hits = 0;
      for (int sample = 0; sample < 16; ++sample) {
        const int dx = 4 * x + sample % 4 - disc.x;
        const int dy = 4 * y + sample / 4 - disc.y;
        if (dx * dx + dy * dy <= disc.r * disc.r) ++hits;
      }
      for (std::size_t c = 0; c < 4 && hits > 0; ++c) {
        std::uint8_t& value = picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x) + c];
        value = static_cast<std::uint8_t>(value + (disc.color.at(c) - value) * hits / 16);
      }
    }
  }
}

void drawLines(Frame& picture, Generator& random) {
  for (int line = 0; line < 6; ++line) {
    const int y = random(picture.height);
    for (int x = random(picture.width); x < picture.width; ++x) {
      std::uint8_t* pixel = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x)];
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(255 - pixel[c]);
    }
  }
}

} // namespace

std::pair<Frame, Frame> picturePair(int number) {
  Generator random(static_cast<std::uint32_t>(1000 + number));
  Frame a;
  a.width = 5 + random(60);
  a.height = 5 + random(50);
  const bool translucent = number % 4 == 3;
  std::array<std::uint8_t, 4> ground{};
  for (std::size_t c = 0; c < 3; ++c) ground.at(c) = static_cast<std::uint8_t>(random(256));
  ground[3] = translucent ? static_cast<std::uint8_t>(random(256)) : std::uint8_t{255};
  for (int i = 0; i < a.width * a.height; ++i) a.rgba.insert(a.rgba.end(), ground.begin(), ground.end());
  Frame b = a;
  const int change = number % 6;
  const int discs = 1 + random(6);
  for (int i = 0; i < discs; ++i) {
    QuarterDisc disc;
    disc.x = random(4 * a.width);
    disc.y = random(4 * a.height);
    disc.r = 4 + random(48);
    for (std::size_t c = 0; c < 3; ++c) disc.color.at(c) = random(256);
    disc.color[3] = translucent ? random(256) : 255;
    drawDisc(a, disc);
    if (change == 0) {
      disc.x += random(9) - 4;
      disc.y += random(9) - 4;
    }
    for (std::size_t c = 0; c < 3 && change == 1; ++c)
      disc.color.at(c) = std::min(255, disc.color.at(c) + random(80));
    if (change == 5) disc.color[3] = std::max(0, disc.color[3] - random(128));
    if (change != 3 || i > 0) drawDisc(b, disc);
  }
  if (change == 2)
    for (std::uint8_t& value : b.rgba) value = static_cast<std::uint8_t>(std::min(255, value + random(30)));
  if (change == 4) drawLines(b, random);
  return {a, b};
}

std::uint32_t pictureHash(const Frame& frame) {
  std::uint32_t value = 2166136261U;
  for (const std::uint8_t byte : frame.rgba) value = (value ^ byte) * 16777619U;
  return value;
}

} // namespace offstage::test
