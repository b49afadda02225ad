#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// What contacts were given in a step, so that the next one can start from there. A contact is found by two
/// bodies, the lower index first, or by a body and a wall (kFirstWall + side).
class ContactMemory {
public:
  static constexpr std::uint32_t kFirstWall = 0xfffffff0U;

  /// Single precision: it is where a search starts, not where it ends.
  struct Entry {
    std::uint32_t other;
    float impulse; ///< px/s, across
  };

  /// The contact's entry, null when it had none.
  [[nodiscard]] const Entry* find(std::uint32_t body, std::uint32_t other) const {
    if (body + std::size_t{1} >= starts_.size()) return nullptr; // came since
    for (std::uint32_t i = starts_[body]; i < starts_[body + 1]; ++i) {
      if (entries_[i].other == other) return &entries_[i];
    }
    return nullptr;
  }
  /// An entry's impulse along the contact, px/s; 0 where there is no friction.
  [[nodiscard]] float rubbing(const Entry& entry) const {
    return rubbings_.empty() ? 0.0F : rubbings_[numberOf(entry)];
  }
  void setRubbing(const Entry& entry, float rubbing) {
    if (rubbings_.empty()) rubbings_.resize(entries_.size(), 0.0F);
    rubbings_[numberOf(entry)] = rubbing;
  }

  /// Takes what visitAll(visit) shows as visit(body, Entry), in place of what was there. It is called twice,
  /// once to count.
  template <typename VisitAll>
  void remember(std::size_t bodies, VisitAll&& visitAll) {
    starts_.assign(bodies + 1, 0U);
    visitAll([&](std::uint32_t body, const Entry&) { ++starts_[body]; });
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts_) { // each body's end, for now
      sum += start;
      start = sum;
    }
    rubbings_.clear();
    entries_.clear(); // so that growing copies nothing
    // Circles that do not overlap touch at most 3 times as often as there are circles (Euler's formula for
    // planar graphs), so a pile need not grow a second time; what it does not use is never written to.
    if (entries_.capacity() < sum) entries_.reserve(std::max<std::size_t>(sum + sum / 16, bodies * 3));
    entries_.resize(sum);
    visitAll([&](std::uint32_t body, const Entry& entry) { entries_[--starts_[body]] = entry; });
  }

  /// Bodies have gone: `removed` holds 1 for each of them, by index.
  void keepOnly(std::span<const std::uint8_t> removed);

private:
  [[nodiscard]] std::size_t numberOf(const Entry& entry) const {
    return static_cast<std::size_t>(&entry - entries_.data());
  }

  std::vector<std::uint32_t> starts_; ///< by body: into entries_; one more than there are bodies
  std::vector<Entry> entries_;
  std::vector<float> rubbings_;        ///< by entry; empty while nothing rubs
  std::vector<std::uint32_t> numbers_; ///< of keepOnly; kept to spare allocations
};

} // namespace offstage
