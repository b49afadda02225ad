// raster_offstage N FRAMES [circles|pattern|paused|first]: workload R drawn into memory. Prints CPU ms a
// frame and the peak memory in KiB; with `first`, what the first frame consists of.
#include "render/raster/canvas.h"
#include "tests/bench/measure.h"
#include "tests/bench/workload.h"

#include <cstdlib>
#include <memory>
#include <string>

#include <fmt/format.h>

namespace {

using namespace offstage;
using namespace offstage::bench;

std::shared_ptr<const Image> patternImage() {
  auto image = std::make_shared<Image>();
  image->width = kPatternSide;
  image->height = kPatternSide;
  for (std::uint32_t y = 0; y < kPatternSide; ++y) {
    for (std::uint32_t x = 0; x < kPatternSide; ++x) {
      const std::uint32_t texel = patternTexel(x, y);
      for (const std::uint32_t shift : {16U, 8U, 0U})
        image->rgba.push_back(static_cast<std::uint8_t>(texel >> shift));
      image->rgba.push_back(255);
    }
  }
  return image;
}

void fill(Picture& picture, const MovingCircles& show, const std::shared_ptr<const Image>& image) {
  picture.clear();
  const Vec2 reach(show.radius, show.radius);
  for (const Circle& circle : show.circles) {
    Primitive primitive;
    primitive.center = Vec2(circle.x, circle.y);
    primitive.outer = show.radius;
    primitive.color = {circle.r, circle.g, circle.b, 255};
    if (image != nullptr) {
      primitive.pattern = static_cast<std::int32_t>(picture.patterns.size());
      picture.patterns.push_back({image, primitive.center - reach, 2.0 * reach, false});
    }
    picture.primitives.push_back(primitive);
  }
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  MovingCircles show(std::atoi(argv[1]));
  const int frames = std::atoi(argv[2]);
  const std::string mode = argc > 3 ? argv[3] : "circles";
  const std::shared_ptr<const Image> image = mode == "pattern" ? patternImage() : nullptr;

  const double atStart = cpuSeconds();
  Canvas canvas(MovingCircles::kWidth, MovingCircles::kHeight);
  const double atCanvas = cpuSeconds();
  Picture picture;
  picture.width = MovingCircles::kWidth;
  picture.height = MovingCircles::kHeight;
  Frame frame;
  const auto draw = [&] {
    fill(picture, show, image);
    canvas.draw(picture, frame);
  };
  draw(); // the first frame compiles shaders
  const double atFirst = cpuSeconds();
  if (mode == "first") {
    draw();
    fmt::print("libraries loaded: {:.1f} ms, context: {:.1f} ms, first frame (shaders): {:.1f} ms, second: "
               "{:.1f} ms\n",
               1e3 * atStart, 1e3 * (atCanvas - atStart), 1e3 * (atFirst - atCanvas),
               1e3 * (cpuSeconds() - atFirst));
    return 0;
  }
  for (int i = 0; i < frames; ++i) {
    if (mode != "paused") show.step();
    draw();
  }
  fmt::print("{:.4f} {}\n", 1e3 * (cpuSeconds() - atFirst) / frames, peakKib());
}
