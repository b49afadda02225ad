#include "src/sim/contact_memory.h"

namespace offstage {

void ContactMemory::keepOnly(std::span<const std::uint8_t> removed) {
  if (starts_.empty()) return;
  constexpr std::uint32_t kGone = 0xffffffffU;
  numbers_.clear();
  std::uint32_t next = 0;
  for (const std::uint8_t gone : removed) numbers_.push_back(gone != 0 ? kGone : next++);
  const auto known = static_cast<std::uint32_t>(starts_.size() - 1);
  std::uint32_t kept = 0; // of the entries
  for (std::uint32_t body = 0; body < known; ++body) {
    const std::uint32_t first = starts_[body];
    const std::uint32_t end = starts_[body + 1];
    if (numbers_[body] == kGone) continue;
    starts_[numbers_[body]] = kept;
    for (std::uint32_t i = first; i < end; ++i) {
      Entry entry = entries_[i];
      if (entry.other < kFirstWall) {
        if (numbers_[entry.other] == kGone) continue;
        entry.other = numbers_[entry.other];
      }
      if (!rubbings_.empty()) rubbings_[kept] = rubbings_[i];
      entries_[kept++] = entry;
    }
  }
  std::uint32_t living = 0;
  for (std::uint32_t body = 0; body < known; ++body) living += numbers_[body] != kGone ? 1U : 0U;
  starts_.resize(living + std::size_t{1});
  starts_[living] = kept;
  entries_.resize(kept);
  if (!rubbings_.empty()) rubbings_.resize(kept);
}

} // namespace offstage
