#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace offstage {

/// A value for each of many colours, for one look-up a pixel: a hash table in one piece, at most half full. A
/// colour is a number of 24 bits (keyOfColor). References last until the next colour is added.
template <class Value>
class ColorTable {
public:
  ColorTable() { clear(); }

  /// The value of a colour, nothing when it has none.
  Value* find(std::uint32_t color) {
    Slot& slot = slots_[slotOf(color)];
    return slot.color == color ? &slot.value : nullptr;
  }

  /// The value of a colour; a new one has a default value.
  Value& operator[](std::uint32_t color) {
    std::size_t at = slotOf(color);
    if (slots_[at].color == color) return slots_[at].value;
    if (2 * (size_ + 1) > slots_.size()) {
      grow();
      at = slotOf(color);
    }
    ++size_;
    slots_[at].color = color;
    return slots_[at].value;
  }

  [[nodiscard]] std::size_t size() const { return size_; }

  void clear() {
    slots_.assign(kFewestSlots, {});
    shift_ = 32 - kFewestBits;
    size_ = 0;
  }

  /// Calls `visit(color, value)` for each, in no order that means anything.
  template <class Visit>
  void forEach(Visit visit) const {
    for (const Slot& slot : slots_)
      if (slot.color != kNone) visit(slot.color, slot.value);
  }

private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr unsigned kFewestBits = 12;
  static constexpr std::size_t kFewestSlots = std::size_t{1} << kFewestBits;
  struct Slot {
    std::uint32_t color = kNone;
    Value value{};
  };

  /// Where the colour is, or where it would go.
  [[nodiscard]] std::size_t slotOf(std::uint32_t color) const {
    // Multiplicative hashing by 2^32 over the golden ratio (D. Knuth, The Art of Computer Programming
    // 3, 6.4).
    std::size_t at = (color * 2654435769U) >> shift_;
    while (slots_[at].color != color && slots_[at].color != kNone) at = (at + 1) % slots_.size();
    return at;
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    std::swap(old, slots_);
    --shift_;
    for (Slot& slot : old)
      if (slot.color != kNone) slots_[slotOf(slot.color)] = std::move(slot);
  }

  std::vector<Slot> slots_;
  unsigned shift_ = 0; ///< of the hash, so that it is a slot's number
  std::size_t size_ = 0;
};

} // namespace offstage
