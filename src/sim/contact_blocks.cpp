#include "src/sim/contact_blocks.h"

#include <algorithm>

namespace offstage {

void ContactBlocks::begin(std::size_t slots, bool even) {
  even_ = even;
  outside_ = static_cast<std::uint32_t>(slots - 1);
  rows_.fill({});
  chunksUsed_ = 0;
  used_.assign(slots, 0U);
  const auto nobody = static_cast<std::uint32_t>(slots);
  empty_.a.fill(nobody);
  empty_.b.fill(nobody);
}

void ContactBlocks::startChunk(Row& row) {
  if (chunksUsed_ == chunks_.size()) {
    // Some to spare, so that a pile that stirs a little does not allocate in every step.
    const std::size_t more = chunks_.size() / 32 + 3;
    next_.resize(chunks_.size() + more);
    for (std::size_t i = 0; i < more; ++i) chunks_.emplace_back(kBlocks);
  }
  if (!even_ && shares_.size() <= chunksUsed_) shares_.resize(chunks_.size());
  if (!even_) shares_[chunksUsed_].resize(kBlocks);
  std::fill(chunks_[chunksUsed_].begin(), chunks_[chunksUsed_].end(), empty_);
  next_[chunksUsed_] = kNone;
  (row.first == kNone ? row.first : next_[row.last]) = chunksUsed_;
  row.last = chunksUsed_;
  row.filled = 0;
  ++chunksUsed_;
}

} // namespace offstage
