#include "tests/support/canvas_pictures.h"

#include "render/draw/pen.h"
#include "render/raster/canvas.h"

#include <cmath>
#include <ostream>

namespace offstage::test {

Picture blankPicture(int width, int height, Rgba8 background) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.background = background;
  return picture;
}

Primitive disc(double x, double y, double radius, Rgba8 color) {
  Primitive primitive;
  primitive.kind = Primitive::Kind::Disc;
  primitive.color = color;
  primitive.center = Vec2(x, y);
  primitive.outer = radius;
  return primitive;
}

Primitive ring(double x, double y, double inner, double outer, Rgba8 color) {
  Primitive primitive = disc(x, y, outer, color);
  primitive.kind = Primitive::Kind::Ring;
  primitive.inner = inner;
  return primitive;
}

Primitive box(double left, double top, double right, double bottom, Rgba8 color) {
  Primitive primitive;
  primitive.kind = Primitive::Kind::Box;
  primitive.color = color;
  primitive.low = Vec2(left, top);
  primitive.high = Vec2(right, bottom);
  return primitive;
}

void addPatternBox(Picture& picture, const std::shared_ptr<const Image>& image, const Vec2& low,
                   const Vec2& high, const Vec2& tile, bool repeat, std::uint8_t alpha) {
  Primitive primitive = box(low.x(), low.y(), high.x(), high.y(), {0, 0, 0, alpha});
  primitive.pattern = static_cast<std::int32_t>(picture.patterns.size());
  picture.patterns.push_back({image, low, tile, repeat});
  picture.primitives.push_back(primitive);
}

std::shared_ptr<const Image> colorfulImage(int width, int height, bool alpha) {
  auto image = std::make_shared<Image>();
  image->width = width;
  image->height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value :
           {x * 37 + y * 11, x * 5 + y * 71, (x ^ y) * 13, alpha ? 40 + x * 19 + y * 7 : 255}) {
        image->rgba.push_back(static_cast<std::uint8_t>(value & 255));
      }
    }
  }
  return image;
}

Frame drawOnce(const Picture& picture) {
  Canvas canvas(picture.width, picture.height);
  Frame frame;
  canvas.draw(picture, frame);
  return frame;
}

Rgba8 pixel(const Frame& frame, int x, int y) {
  const std::size_t at = 4UL * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                static_cast<std::size_t>(x));
  return {frame.rgba.at(at), frame.rgba.at(at + 1), frame.rgba.at(at + 2), frame.rgba.at(at + 3)};
}

void addEveryLine(Picture& picture) {
  std::vector<Vec2> zigzag;
  std::vector<Vec2> curve;
  for (int i = 0; i < 40; ++i) {
    zigzag.emplace_back(10.3 + 7.9 * i, 30.2 + 1.7 * ((i * 29) % 31));
    curve.emplace_back(12.1 + 7.7 * i, 120.4 + 40.0 * std::sin(0.21 * i));
  }
  Pen(picture, 2.7, {200, 30, 60, 130}).path(zigzag);
  Pen(picture, 4.3, {20, 90, 190, 200}).path(curve);
  Pen(picture, 0.8, {0, 0, 0, 255}).path(std::span(curve).first(2));
  picture.clips.push_back({40, 30, 250, 160});
  Pen clipped(picture, 1.9, {10, 140, 60, 220}, static_cast<std::int32_t>(picture.clips.size()) - 1);
  for (int i = 0; i < 12; ++i) {
    const Vec2 ray(std::cos(0.55 * i), std::sin(0.55 * i));
    const Vec2 from = Vec2(160.3, 100.2) + ray * 12.0;
    clipped.arrow(from, from + ray * (4.0 + 11.0 * i), 9.0);
    clipped.line(from + Vec2(3.0, 5.0), from + ray * 90.0);
    clipped.dashes(from - Vec2(9.0, 2.0), from + ray * 70.0, 6.0, 4.0);
  }
}

Picture everythingPicture() {
  Picture picture = blankPicture(333, 217, {250, 251, 240, 255});
  auto& primitives = picture.primitives;
  const auto shade = [](int i, std::uint8_t alpha) {
    return Rgba8{static_cast<std::uint8_t>(i * 53), static_cast<std::uint8_t>(i * 101 + 40),
                 static_cast<std::uint8_t>(i * 29 + 90), alpha};
  };
  for (int i = 0; i < 60; ++i) {
    const double x = 7.3 + 5.37 * i;
    const double y = 20.0 + 0.61 * ((i * 37) % 100);
    primitives.push_back(disc(x, y, 0.1 + 0.37 * i, shade(i, i % 3 == 0 ? 255 : 120)));
    primitives.push_back(ring(x, y + 80.0, 0.31 * i, 0.31 * i + 0.4 + 0.05 * i, shade(i + 7, 200)));
    primitives.push_back(box(x, y + 130.0, x + 3.3 + 0.1 * i, y + 141.7, shade(i + 3, 255)));
  }
  Primitive frame = box(200.3, 150.2, 320.8, 210.6, shade(2, 180));
  frame.kind = Primitive::Kind::BoxRing;
  frame.innerLow = Vec2(204.9, 155.1);
  frame.innerHigh = Vec2(310.2, 200.4);
  primitives.push_back(frame);
  primitives.push_back(disc(150.4, 1e6 + 190.3, 1e6, shade(5, 90)));
  primitives.push_back(ring(-3e4, 100.0, 3e4 + 300.2, 3e4 + 303.9, shade(6, 255)));
  addEveryLine(picture);
  const auto opaque = colorfulImage(64, 48, false);
  const auto translucent = colorfulImage(37, 53, true);
  for (int i = 0; i < 12; ++i) {
    const double size = 1.5 * (i + 1);
    const Vec2 low(5.4 + 26.0 * i, 60.2);
    addPatternBox(picture, i % 2 == 0 ? opaque : translucent, low, low + Vec2(24.0, 30.5),
                  Vec2(size, 2.5 * size), true);
    Primitive round = disc(18.3 + 26.0 * i, 120.7, 1.0 + i, {0, 0, 0, 200});
    round.pattern = static_cast<std::int32_t>(picture.patterns.size());
    picture.patterns.push_back({i % 2 == 0 ? translucent : opaque, round.center - Vec2(1.0 + i, 1.0 + i),
                                Vec2(2.0 + 2.0 * i, 2.0 + 2.0 * i), false});
    primitives.push_back(round);
  }
  return picture;
}

} // namespace offstage::test
