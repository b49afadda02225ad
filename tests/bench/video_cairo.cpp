// video_cairo raw N FRAMES: workload R drawn by cairo, BGRA frames on standard output, as people pipe them
// into ffmpeg. video_cairo scene N FRAMES: the same workload as a scene file.
#include "tests/bench/workload.h"

#include <cairo/cairo.h>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>

namespace {

using namespace offstage::bench;

void writeScene(const MovingCircles& show, int frames) {
  std::printf("duration = %.17g\n[frame]\nsize = [%d, %d]\n[clock]\nfps = 60\n[world]\ngravity = [0, 0]\n"
              "[walls]\nall = 1.0\n",
              frames / 60.0, MovingCircles::kWidth, MovingCircles::kHeight);
  for (const Circle& circle : show.circles) {
    std::printf(
        "[[body]]\nshape = \"circle\"\ncenter = [%.17g, %.17g]\nradius = %.17g\nvelocity = [%.17g, %.17g]\n"
        "fill = \"#%02x%02x%02x\"\n",
        circle.x, circle.y, show.radius, circle.vx, circle.vy, circle.r, circle.g, circle.b);
  }
}

bool writeFrames(MovingCircles& show, int frames) {
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, MovingCircles::kWidth, MovingCircles::kHeight);
  cairo_t* cairo = cairo_create(surface);
  const std::size_t bytes = std::size_t{4} * MovingCircles::kWidth * MovingCircles::kHeight;
  bool written = true;
  for (int i = 0; i < frames && written; ++i) {
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_paint(cairo);
    for (const Circle& circle : show.circles) {
      cairo_set_source_rgb(cairo, circle.r / 255.0, circle.g / 255.0, circle.b / 255.0);
      cairo_arc(cairo, circle.x, circle.y, show.radius, 0.0, 2.0 * std::numbers::pi);
      cairo_fill(cairo);
    }
    cairo_surface_flush(surface);
    written = std::fwrite(cairo_image_surface_get_data(surface), 1, bytes, stdout) == bytes;
    show.step();
  }
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return written;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  MovingCircles show(std::atoi(argv[2]));
  const int frames = std::atoi(argv[3]);
  if (std::strcmp(argv[1], "scene") == 0) {
    writeScene(show, frames);
    return 0;
  }
  return writeFrames(show, frames) ? 0 : 1;
}
