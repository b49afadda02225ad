#include "render/draw/painter.h"
#include "render/raster/canvas.h"
#include "tests/support/image_compare.h"
#include "tests/support/still_scene.h"

#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using namespace offstage::test;

/// How far a still may be from JavaFX's, by oracle/README.md.
struct Tolerance {
  int worst = 26;     ///< /255
  double psnr = 45.0; ///< dB
};

Frame draw(const Still& still) {
  Painter painter(Viewport::scaled(still.width, still.height, 1.0), still.background);
  Picture picture;
  painter.begin(picture);
  for (const StillShape& shape : still.shapes) {
    const std::uint32_t look = painter.addLook(shape.look);
    if (shape.circle) {
      painter.circle(picture, shape.position, shape.radius, look);
    } else {
      painter.rectangle(picture, shape.position, shape.size, look);
    }
  }
  Canvas canvas(still.width, still.height);
  Frame frame;
  canvas.draw(picture, frame);
  return frame;
}

/// Whether the pixel shows the outermost texel of a copy of the pattern, where JavaFX wraps around: it blends
/// the image's last texel with its first, and its first with its second.
bool showsOutermostTexel(const ImagePattern& pattern, const Vec2& low, const Vec2& size,
                         const Vec2& imageSize, const Vec2& pixel) {
  Vec2 origin(pattern.anchor[0], pattern.anchor[1]);
  Vec2 tile(pattern.anchor[2], pattern.anchor[3]);
  if (pattern.proportional) {
    origin = low + origin.cwiseProduct(size);
    tile = tile.cwiseProduct(size);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double tiles = (pixel[axis] - origin[axis]) / tile[axis];
    const double texels = (tiles - std::floor(tiles)) * imageSize[axis];
    if (std::min(texels, imageSize[axis] - texels) < 1.0) return true;
  }
  return false;
}

/// A mask of the pixels that showsOutermostTexel() is true for, for any shape that reaches them.
std::vector<bool> outermostTexels(const Still& still) {
  std::vector<bool> mask(static_cast<std::size_t>(still.width) * static_cast<std::size_t>(still.height));
  ImageCache images;
  for (const StillShape& shape : still.shapes) {
    const Vec2 reach(shape.radius, shape.radius);
    const Vec2 low = shape.circle ? Vec2(shape.position - reach) : shape.position;
    const Vec2 size = shape.circle ? Vec2(2.0 * reach) : shape.size;
    const auto mark = [&](const Paint& paint, double outward) {
      const auto* pattern = std::get_if<ImagePattern>(&paint);
      if (pattern == nullptr) return;
      const auto image = images.get(*pattern);
      const Vec2 margin(outward, outward);
      const Vec2 first = (low - margin).array().floor();
      const Vec2 last = low + size + margin;
      for (int y = std::max(0, static_cast<int>(first.y())); y < std::min<double>(still.height, last.y());
           ++y) {
        for (int x = std::max(0, static_cast<int>(first.x())); x < std::min<double>(still.width, last.x());
             ++x) {
          if (showsOutermostTexel(*pattern, low, size, Vec2(image->width, image->height),
                                  Vec2(x + 0.5, y + 0.5))) {
            mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(still.width) +
                 static_cast<std::size_t>(x)] = true;
          }
        }
      }
    };
    if (shape.look.fill) mark(*shape.look.fill, 0.0);
    if (shape.look.stroke) mark(shape.look.stroke->paint, shape.look.stroke->width);
  }
  return mask;
}

ImageDifference compareStill(const std::string& name) {
  const Still still = loadStill(name);
  const std::vector<bool> skipped = outermostTexels(still);
  const Frame frame = draw(still);
  const ImageDifference difference =
      compareImages(frame.rgba, still.expected.rgba, still.width, still.height, [&](int x, int y) {
        return skipped[static_cast<std::size_t>(y) * static_cast<std::size_t>(still.width) +
                       static_cast<std::size_t>(x)];
      });
  std::cout << name << ": " << difference << '\n';
  return difference;
}

void expectWithin(const std::string& name, const Tolerance& tolerance) {
  const ImageDifference difference = compareStill(name);
  EXPECT_LE(difference.worst, tolerance.worst) << name << ": " << difference;
  EXPECT_GE(difference.psnr, tolerance.psnr) << name << ": " << difference;
  EXPECT_GT(difference.compared, 200000U) << name << ": too little was compared";
}

TEST(Still, SolidCircles) {
  expectWithin("01_solid_circles", {});
}
TEST(Still, FractionalCentres) {
  expectWithin("02_fractional_centres", {});
}
TEST(Still, Rectangles) {
  expectWithin("05_rectangles", {});
}
TEST(Still, Strokes) {
  expectWithin("06_strokes", {.worst = 34}); // JavaFX's strokes of circles are polygons on both sides
}
TEST(Still, PatternsStretchedOverTheShape) {
  expectWithin("08_pattern_default", {});
}
TEST(Still, PatternsTiledInThePane) {
  expectWithin("09_pattern_absolute", {});
}
TEST(Still, PatternsWithAlphaOpacityAndStrokes) {
  expectWithin("11_pattern_alpha", {});
}
TEST(Still, ZeroAndHugeRadii) {
  // JavaFX's edge of a radius of 2000 px and more is up to 0.3 px out, so single edge pixels say nothing.
  expectWithin("14_zero_and_huge", {.worst = 255, .psnr = 38.0});
}

TEST(Still, ZeroSizesPaintNeitherFillNorStroke) {
  // JavaFX paints nothing for the circles of radius 0 and the rectangles of size 0, stroked or not.
  const Still still = loadStill("14_zero_and_huge");
  const Frame frame = draw(still);
  int checked = 0;
  for (const StillShape& shape : still.shapes) {
    if (shape.circle ? shape.radius > 0.0 : shape.size.x() > 0.0) continue;
    ++checked;
    const auto left = static_cast<int>(shape.position.x()) - 8;
    const auto top = static_cast<int>(shape.position.y()) - 8;
    for (int y = top; y < top + 16; ++y) {
      for (int x = left; x < left + 16; ++x) {
        const std::size_t at = 4UL * (static_cast<std::size_t>(y) * static_cast<std::size_t>(still.width) +
                                      static_cast<std::size_t>(x));
        EXPECT_NEAR(frame.rgba[at], still.expected.rgba[at], 2) << x << ", " << y;
        EXPECT_NEAR(frame.rgba[at + 1], still.expected.rgba[at + 1], 2) << x << ", " << y;
      }
    }
  }
  EXPECT_EQ(checked, 14);
}

} // namespace
} // namespace offstage
