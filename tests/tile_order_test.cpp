#include "render/raster/canvas.h"
#include "render/raster/tile_order.h"
#include "tests/support/canvas_pictures.h"
#include "tests/support/quads.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr int kWidth = 333;
constexpr int kHeight = 217;
constexpr int kTile = 64;

int tileOf(const Instance& instance) {
  return instance.quad[1] / kTile * 100 + instance.quad[0] / kTile;
}

std::vector<std::uint32_t> everyThird(std::size_t count) {
  std::vector<std::uint32_t> members(count);
  for (std::size_t i = 0; i < count; ++i) members[i] = static_cast<std::uint32_t>(3 * i);
  return members;
}

TEST(TileOrder, KeepsTheOrderOfWhatOverlapsAndDrawsEachOnce) {
  std::mt19937 random(23);
  TileOrder order(kWidth, kHeight);
  for (const int largest : {3, 20, 150}) {
    std::vector<Instance> instances;
    for (std::size_t i = 0; i < 3 * TileOrder::kLargeBatch; ++i) {
      const int left = static_cast<int>(random() % (kWidth - 1));
      const int top = static_cast<int>(random() % (kHeight - 1));
      const auto side = [&](int room) {
        return 1 + static_cast<int>(random() % static_cast<unsigned>(std::min(largest, room)));
      };
      instances.push_back(i % 50 == 0 ? Instance{}
                                      : quad(left, top, side(kWidth - left), side(kHeight - top)));
    }
    const std::vector<std::uint32_t> members = everyThird(TileOrder::kLargeBatch);
    const auto sorted = order.sorted(members, instances);
    ASSERT_EQ(sorted.size(), members.size());
    EXPECT_TRUE(std::is_permutation(sorted.begin(), sorted.end(), members.begin())) << largest;
    int wrong = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t j = i + 1; j < sorted.size(); ++j)
        wrong += sorted[i] > sorted[j] && overlap(instances[sorted[i]], instances[sorted[j]]) ? 1 : 0;
    EXPECT_EQ(wrong, 0) << "pairs in the wrong order, of instances up to " << largest << " px wide";
  }
}

TEST(TileOrder, InstancesApartComeTileByTile) {
  std::vector<Instance> instances; // one a cell of 8 px, in an order of its own
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 50; ++x) instances.push_back(quad(8 * x, 8 * y, 8, 8));
  std::shuffle(instances.begin(), instances.end(), std::mt19937(5));
  std::vector<std::uint32_t> members(instances.size());
  std::iota(members.begin(), members.end(), 0U);
  TileOrder order(400, 400);
  int last = 0;
  std::uint32_t before = 0;
  for (const std::uint32_t i : order.sorted(members, instances)) {
    const int tile = tileOf(instances[i]);
    EXPECT_GE(tile, last);
    if (tile == last) {
      EXPECT_GE(i, before) << "in tile " << tile;
    }
    last = tile;
    before = i;
  }
  EXPECT_EQ(last, 606);
}

TEST(TileOrder, SmallBatchesStayAsTheyAre) {
  const std::vector<Instance> instances{quad(200, 200, 9, 9), quad(0, 0, 9, 9)};
  const std::vector<std::uint32_t> members{0, 1};
  TileOrder order(kWidth, kHeight);
  const auto sorted = order.sorted(members, instances);
  EXPECT_EQ(sorted.data(), members.data());
  EXPECT_EQ(sorted.size(), 2U);
}

TEST(TileOrder, ACrowdOfBoxesShowsTheLastOneOnEveryPixel) {
  Picture picture = blankPicture(kWidth, kHeight, {0, 0, 0, 255});
  std::vector<Rgba8> expected(std::size_t{kWidth} * kHeight, picture.background);
  const auto shownAt = [&expected](int x, int y) -> Rgba8& {
    return expected[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)];
  };
  std::mt19937 random(11);
  for (std::size_t i = 0; i < 2 * TileOrder::kLargeBatch; ++i) {
    const int left = static_cast<int>(random() % (kWidth - 30));
    const int top = static_cast<int>(random() % (kHeight - 30));
    const int right = left + 1 + static_cast<int>(random() % 30);
    const int bottom = top + 1 + static_cast<int>(random() % 30);
    const Rgba8 color{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8U), 77, 255};
    picture.primitives.push_back(box(left, top, right, bottom, color));
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) shownAt(x, y) = color;
  }
  const Frame frame = drawOnce(picture);
  int wrong = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) wrong += pixel(frame, x, y) == shownAt(x, y) ? 0 : 1;
  EXPECT_EQ(wrong, 0) << "pixels";
}

} // namespace
} // namespace offstage::test
