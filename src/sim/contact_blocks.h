#pragma once

#include "src/sim/processor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// The part of a body's state that changes within a step, by slot.
struct SlotState {
  double vx = 0.0, vy = 0.0; ///< px/s
  double x = 0.0, y = 0.0;   ///< px: of the centre
};

/// Two bodies in touch, or about to be. Impulses are measured by the change of the normal velocity that they
/// make, px/s, so that masses enter only by how the two share it.
struct PileContact {
  std::uint32_t a = 0, b = 0; ///< slots
  double nx = 1.0, ny = 0.0;  ///< unit normal from a to b; stays as it is during the step
  double touch = 0.0;         ///< px: how far the centres are apart along the normal when they just touch
  double share =
      0.5; ///< of a velocity change that a takes, wa/(wa + wb) with w = 1/mass (fixed: 0); b takes the rest
  double impulse = 0.0; ///< px/s, ≥ 0: to start from
};

/// How hard a sweep pushes overlaps apart: a damped spring, integrated implicitly, in the form of E. Catto,
/// "Soft Constraints" (GDC 2011), slides 31–33: for an overlap of depth C the impulse is
///   −mass·(vn + rate·C) − impulse·(what was given so far).
struct Softness {
  double rate;    ///< 1/s
  double mass;    ///< 0 … 1
  double impulse; ///< 0 … 1
};

/// The contacts of a step in the order in which they are solved. Contacts are divided into colours: within a
/// colour no body that can move occurs twice, so that several contacts at a time give the bits of one after
/// the other. A contact takes the first colour that both its bodies have free (greedy edge colouring, in the
/// order of add()); when there is none, the last, in which contacts do go one after the other.
class ContactBlocks {
public:
  /// Names a contact until the next begin().
  struct Place {
    std::uint32_t number; ///< of its chunk times those that a chunk holds, and its own within the chunk
  };

  /// `wide`: four contacts at a time rather than two. The bits are the same.
  explicit ContactBlocks(bool wide = processorIsWide()) : wide_(wide) {}

  /// Forgets all contacts. `slots`: bodies that add() may name, at least one; the last of them never moves.
  /// `even`: all the others have one mass, so that a pair shares evenly, and shares need not be kept.
  void begin(std::size_t slots, bool even);
  Place add(const PileContact& contact) {
    const std::uint32_t taken = used_[contact.a] | used_[contact.b];
    const auto colour = std::min<std::size_t>(static_cast<std::size_t>(std::countr_one(taken)), kLast);
    const std::uint32_t bit = 1U << colour;
    // A fixed body takes no part of a velocity change, so it may occur any number of times.
    if (contact.share > 0.0) used_[contact.a] |= bit;
    if (contact.share < 1.0) used_[contact.b] |= bit;

    Row& row = rows_[colour];
    if (row.filled == kChunk) startChunk(row);
    const Place place{row.last * kChunk + row.filled};
    const std::size_t lane = row.filled % kLanes;
    Block& block = chunks_[row.last][row.filled / kLanes];
    if (!even_) shares_[row.last][row.filled / kLanes][lane] = contact.share;
    row.filled += colour == kLast ? std::uint32_t{kLanes} : 1U;
    block.a[lane] = contact.a;
    block.b[lane] = contact.b;
    block.nx[lane] = contact.nx;
    block.ny[lane] = contact.ny;
    block.touch[lane] = contact.touch;
    block.impulse[lane] = contact.impulse;
    return place;
  }

  [[nodiscard]] double impulse(Place place) const {
    return chunks_[place.number / kChunk][place.number % kChunk / kLanes].impulse[place.number % kLanes];
  }
  void setImpulse(Place place, double impulse) {
    chunks_[place.number / kChunk][place.number % kChunk / kLanes].impulse[place.number % kLanes] = impulse;
  }
  [[nodiscard]] PileContact contact(Place place) const {
    return contactOf(place.number / kChunk, place.number % kChunk);
  }
  /// Whether a slot that can move has a contact.
  [[nodiscard]] bool touches(std::uint32_t slot) const { return used_[slot] != 0; }

  // Each goes through all contacts once and changes velocities. `states` has one entry more than there are
  // slots, at the end, for the empty lanes of a block.
  void warmStart(std::span<SlotState> states);
  /// Pushes overlaps apart, and lets open gaps close at most within a step of length h.
  void solve(std::span<SlotState> states, double h, const Softness& softness);
  /// The same without pushing: takes back the speed that solve() used to push.
  void relax(std::span<SlotState> states, double h);

  /// Calls visit(contact) for every contact, with its impulse as it is now.
  template <typename Visit>
  void forEach(Visit&& visit) {
    forEachChunk([&](std::uint32_t number, std::uint32_t count) {
      for (std::uint32_t i = 0; i < count * kLanes; ++i) {
        const Block& block = chunks_[number][i / kLanes];
        if (block.a[i % kLanes] != block.b[i % kLanes]) visit(contactOf(number, i)); // else an empty lane
      }
    });
  }

private:
  static constexpr std::uint32_t kLanes = 4;
  static constexpr std::uint32_t kBlocks = 8;               ///< of a chunk
  static constexpr std::uint32_t kChunk = kLanes * kBlocks; ///< contacts of one
  static constexpr std::size_t kColours = 32;
  static constexpr std::size_t kLast = kColours - 1; ///< the colour of one after the other
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Contacts, value by value.
  struct Block {
    std::array<std::uint32_t, kLanes> a, b;
    std::array<double, kLanes> nx, ny, touch, impulse;
  };
  using Shares = std::array<double, kLanes>; ///< PileContact::share, of a block
  /// A colour's chunks. All are full but the last.
  struct Row {
    std::uint32_t first = kNone, last = kNone; ///< into chunks_
    std::uint32_t filled = kChunk;             ///< contacts in the last one
  };

  /// The share of a contact with b where they are even: `outside` takes nothing.
  static double evenShare(std::uint32_t b, std::uint32_t outside) { return b == outside ? 1.0 : 0.5; }
  [[nodiscard]] PileContact contactOf(std::uint32_t chunk, std::uint32_t index) const {
    const Block& block = chunks_[chunk][index / kLanes];
    const std::size_t lane = index % kLanes;
    const double share = even_ ? evenShare(block.b[lane], outside_) : shares_[chunk][index / kLanes][lane];
    return {block.a[lane],     block.b[lane], block.nx[lane],     block.ny[lane],
            block.touch[lane], share,         block.impulse[lane]};
  }
  /// Calls visit(chunk, number of its blocks), colour by colour.
  template <typename Visit>
  void forEachChunk(Visit&& visit) {
    for (const Row& row : rows_) {
      for (std::uint32_t number = row.first; number != kNone; number = next_[number]) {
        visit(number, number == row.last ? (row.filled + kLanes - 1) / kLanes : kBlocks);
      }
    }
  }
  void startChunk(Row& row);
  /// What a sweep works on: blocks of one colour, and their shares where these are kept.
  struct Run {
    Block* blocks;
    const Shares* shares;
    std::uint32_t count;
    std::uint32_t outside;
  };
  [[nodiscard]] Run runOf(std::uint32_t chunk, std::uint32_t count) {
    return {chunks_[chunk].data(), even_ ? nullptr : shares_[chunk].data(), count, outside_};
  }
  template <bool Even>
  static void warmStartRun(const Run& run, SlotState* states);
  template <bool Pushes, bool Even>
  static void sweepByTwo(const Run& run, SlotState* states, double perStep, const Softness& softness);
  template <bool Pushes, bool Even>
  static void sweepByFour(const Run& run, SlotState* states, double perStep, const Softness& softness);
  template <bool Pushes, bool Even>
  void sweep(std::span<SlotState> states, double h, const Softness& softness);

  bool wide_;
  bool even_ = false;
  std::uint32_t outside_ = 0; ///< the slot of what never moves

  std::array<Row, kColours> rows_{}; ///< by colour
  /// Blocks of one colour each. They stay where they are, so that growing neither copies nor doubles them.
  std::vector<std::vector<Block>> chunks_;
  std::vector<std::vector<Shares>> shares_; ///< by chunk; none where they are even
  std::vector<std::uint32_t> next_;         ///< by chunk: the colour's next, kNone after the last
  std::uint32_t chunksUsed_ = 0;
  Block empty_{};                   ///< of nobody
  std::vector<std::uint32_t> used_; ///< by slot: a bit for each colour that it occurs in
};

} // namespace offstage
