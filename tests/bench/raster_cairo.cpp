// raster_cairo N FRAMES [circles|pattern]: workload R drawn by cairo. Prints CPU ms a frame and the peak
// memory in KiB.
#include "tests/bench/measure.h"
#include "tests/bench/workload.h"

#include <cairo/cairo.h>
#include <cstdlib>
#include <numbers>
#include <string>

#include <fmt/format.h>

namespace {

using namespace offstage::bench;

class CairoPainter {
public:
  CairoPainter() {
    auto* texels = cairo_image_surface_create(CAIRO_FORMAT_RGB24, kPatternSide, kPatternSide);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(texels)) / 4;
    auto* first = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(texels));
    for (std::uint32_t y = 0; y < kPatternSide; ++y)
      for (std::uint32_t x = 0; x < kPatternSide; ++x) first[y * stride + x] = patternTexel(x, y);
    cairo_surface_mark_dirty(texels);
    pattern_ = cairo_pattern_create_for_surface(texels);
    cairo_surface_destroy(texels);
    cairo_pattern_set_filter(pattern_, CAIRO_FILTER_BILINEAR);
    cairo_pattern_set_extend(pattern_, CAIRO_EXTEND_PAD);
  }
  ~CairoPainter() {
    cairo_pattern_destroy(pattern_);
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
  }
  CairoPainter(const CairoPainter&) = delete;
  CairoPainter& operator=(const CairoPainter&) = delete;

  void draw(const MovingCircles& show, bool patterned) {
    cairo_set_source_rgb(cairo_, 1.0, 1.0, 1.0);
    cairo_paint(cairo_);
    for (const Circle& circle : show.circles) {
      if (patterned) {
        placePattern(circle.x - show.radius, circle.y - show.radius, 2.0 * show.radius);
      } else {
        cairo_set_source_rgb(cairo_, circle.r / 255.0, circle.g / 255.0, circle.b / 255.0);
      }
      cairo_arc(cairo_, circle.x, circle.y, show.radius, 0.0, 2.0 * std::numbers::pi);
      cairo_fill(cairo_);
    }
    cairo_surface_flush(surface_);
  }

private:
  void placePattern(double left, double top, double side) {
    cairo_matrix_t matrix;
    cairo_matrix_init_scale(&matrix, kPatternSide / side, kPatternSide / side);
    cairo_matrix_translate(&matrix, -left, -top);
    cairo_pattern_set_matrix(pattern_, &matrix);
    cairo_set_source(cairo_, pattern_);
  }

  cairo_surface_t* surface_ =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, MovingCircles::kWidth, MovingCircles::kHeight);
  cairo_t* cairo_ = cairo_create(surface_);
  cairo_pattern_t* pattern_ = nullptr;
};

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  MovingCircles show(std::atoi(argv[1]));
  const int frames = std::atoi(argv[2]);
  const bool patterned = argc > 3 && std::string(argv[3]) == "pattern";
  CairoPainter painter;
  painter.draw(show, patterned);
  const double start = cpuSeconds();
  for (int i = 0; i < frames; ++i) {
    show.step();
    painter.draw(show, patterned);
  }
  fmt::print("{:.4f} {}\n", 1e3 * (cpuSeconds() - start) / frames, peakKib());
}
