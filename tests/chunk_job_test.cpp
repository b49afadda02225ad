#include "render/job/chunk_job.h"
#include "tests/support/temp_dir.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// A disc that moves; counts how often it is drawn.
class CountedSource : public Source {
public:
  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] const std::string& title() const override { return title_; }
  [[nodiscard]] std::int64_t frame() const override { return frame_; }
  void step() override { ++frame_; }
  void draw(Picture& picture) const override {
    ++draws_;
    picture = {};
    picture.width = 64;
    picture.height = 16;
    Primitive disc;
    disc.center = Vec2(static_cast<double>(frame_), 8.0);
    disc.outer = 6.0;
    disc.color = {200, 30, 30, 255};
    picture.primitives.push_back(disc);
  }
  [[nodiscard]] std::uint64_t stateHash() const override { return 0; }
  [[nodiscard]] std::uint64_t fingerprint() const override { return 0; }

  [[nodiscard]] int draws() const { return draws_; }

private:
  Clock clock_ = Clock::fixed(60.0, 30);
  std::string title_;
  std::int64_t frame_ = 0;
  mutable int draws_ = 0;
};

struct Made {
  int draws;
  std::string chunk;
};

Made makeOne(const std::string& out, bool hashes) {
  const TempDir dir;
  CountedSource source;
  const Schedule schedule(source.clock(), {}, {}, {});
  const ChunkPlan plan(schedule.frames());
  const auto output = makeChunkedOutput(dir / out, {64, 16, false, 60.0, "", {}});
  Manifest manifest;
  manifest.add("scene", "none");
  Parts parts(dir / out, manifest, Parts::Use::Whole, false);
  SharedState state(plan.chunks());
  FrameMaker frames(source, schedule);
  const int before = source.draws(); // for the picture's size
  makeChunk({schedule, plan, *output, parts, state, hashes}, 0, frames);
  EXPECT_EQ(plan.chunks(), 1);
  EXPECT_EQ(state.frames(), 30);
  Made made{source.draws() - before, readFile(parts.chunk(0))};
  parts.removeAll();
  return made;
}

TEST(ChunkJob, FramesThatTheOutputDoesNotHoldAreNotDrawn) {
  const Made half = makeOne("x.gif", false); // at 60 a second a .gif has every other one
  EXPECT_EQ(half.draws, 15);
  const Made hashed = makeOne("x.gif", true);
  EXPECT_EQ(hashed.draws, 30) << "each has a line of hashes";
  EXPECT_TRUE(half.chunk == hashed.chunk);
  EXPECT_EQ(makeOne("x.apng", false).draws, 30);
}

} // namespace
} // namespace offstage::test
