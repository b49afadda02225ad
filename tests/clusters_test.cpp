#include "render/compare/clusters.h"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// The same by flood fill, a pixel at a time.
Clusters flooded(const BitPlane& plane, int width, int height) {
  Clusters result;
  std::vector<bool> seen(static_cast<std::size_t>(width * height), false);
  const auto grow = [](PixelRect& box, int x, int y) {
    if (box.empty()) box = {x, y, x + 1, y + 1};
    box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
           std::max(box.bottom, y + 1)};
  };
  for (int startY = 0; startY < height; ++startY) {
    for (int startX = 0; startX < width; ++startX) {
      const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      };
      if (!plane.get(startX, startY) || seen[index(startX, startY)]) continue;
      std::vector<std::pair<int, int>> open{{startX, startY}};
      seen[index(startX, startY)] = true;
      std::int64_t pixels = 0;
      PixelRect box;
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        ++pixels;
        grow(box, x, y);
        grow(result.box, x, y);
        for (int ny = std::max(0, y - 1); ny <= std::min(height - 1, y + 1); ++ny) {
          for (int nx = std::max(0, x - 1); nx <= std::min(width - 1, x + 1); ++nx) {
            if (!plane.get(nx, ny) || seen[index(nx, ny)]) continue;
            seen[index(nx, ny)] = true;
            open.emplace_back(nx, ny);
          }
        }
      }
      ++result.count;
      result.pixels += pixels;
      if (pixels > result.largest) {
        result.largest = pixels;
        result.largestBox = box;
      }
    }
  }
  return result;
}

TEST(Clusters, EqualAFloodFillOnRandomPlanesOfEveryDensity) {
  std::mt19937 random(7);
  for (const int width : {1, 5, 63, 64, 65, 130}) {
    for (const int percent : {0, 1, 10, 30, 45, 60, 90, 100}) {
      const int height = 1 + static_cast<int>(random() % 40);
      BitPlane plane(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          if (static_cast<int>(random() % 100) < percent) plane.set(x, y);
      const Clusters found = findClusters(plane, width, height);
      const Clusters wanted = flooded(plane, width, height);
      EXPECT_EQ(found.count, wanted.count) << width << "x" << height << " at " << percent << " %";
      EXPECT_EQ(found.pixels, wanted.pixels);
      EXPECT_EQ(found.largest, wanted.largest);
      EXPECT_EQ(found.box, wanted.box);
      EXPECT_EQ(found.largestBox, wanted.largestBox) << width << "x" << height << " at " << percent << " %";
    }
  }
}

TEST(Clusters, CornersTouch) {
  BitPlane plane(4, 3);
  plane.set(0, 0);
  plane.set(1, 1);
  plane.set(3, 1);
  plane.set(2, 2);
  const Clusters found = findClusters(plane, 4, 3);
  EXPECT_EQ(found.count, 1);
  EXPECT_EQ(found.largest, 4);
  EXPECT_EQ(found.box, (PixelRect{0, 0, 4, 3}));
}

} // namespace
} // namespace offstage::test
