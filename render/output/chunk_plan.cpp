#include "render/output/chunk_plan.h"

namespace offstage {
namespace {

// A key frame costs 3 to 20 frames of the others here, so chunks of less than this would show in the file's
// size.
constexpr std::int64_t kLeastChunkFrames = 24;
constexpr std::int64_t kFew = 2;
constexpr std::int64_t kMany = 4;

std::int64_t chunksFor(std::int64_t frames) {
  if (frames < kFew * kLeastChunkFrames) return 1;
  if (frames < kFew * kMostChunkFrames) return kFew;
  return kMany * ((frames + kMany * kMostChunkFrames - 1) / (kMany * kMostChunkFrames));
}

} // namespace

ChunkPlan::ChunkPlan(std::int64_t frames) : frames_(frames), chunks_(chunksFor(frames)) {}

std::int64_t ChunkPlan::begin(std::int64_t chunk) const {
  // In two parts, so that the product cannot overflow.
  return frames_ / chunks_ * chunk + frames_ % chunks_ * chunk / chunks_;
}

} // namespace offstage
