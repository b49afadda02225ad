#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// The part of a body's state that contacts change, by slot.
struct SlotState {
  double vx = 0.0, vy = 0.0; ///< px/s
  double dx = 0.0, dy = 0.0; ///< px: how far it has moved in this step
};

/// Two bodies in touch, or about to be. Impulses are measured by the change of the normal velocity that they
/// make, px/s, so that masses enter only by how the two share it.
struct PileContact {
  std::uint32_t a = 0, b = 0; ///< slots
  double nx = 1.0, ny = 0.0;  ///< unit normal from a to b
  double gap = 0.0;           ///< px, at the step's start; negative: overlap
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
/// colour no body that can move occurs twice, so that two contacts at a time give the bits of one after the
/// other. A contact takes the first colour that both its bodies have free (greedy edge colouring, in the
/// order of add()); when there is none, the last, in which contacts do go one after the other.
class ContactBlocks {
public:
  /// Names a contact until the next begin().
  struct Place {
    std::uint32_t colour;
    std::uint32_t index;
  };

  /// Forgets all contacts. `slots`: bodies that add() may name.
  void begin(std::size_t slots);
  Place add(const PileContact& contact);

  [[nodiscard]] double impulse(Place place) const;
  void setImpulse(Place place, double impulse);
  /// Whether a slot that can move has a contact.
  [[nodiscard]] bool touches(std::uint32_t slot) const { return used_[slot] != 0; }

  // Each goes through all contacts once and changes velocities. `states` has one entry more than there are
  // slots, at the end, for the empty half of a block.
  void warmStart(std::span<SlotState> states) const;
  /// Pushes overlaps apart, and lets open gaps close at most within a step of length h.
  void solve(std::span<SlotState> states, double h, const Softness& softness);
  /// The same without pushing: takes back the speed that solve() used to push.
  void relax(std::span<SlotState> states, double h);

  /// Calls visit(contact) for every contact, with its impulse as it is now.
  template <typename Visit>
  void forEach(Visit&& visit) const {
    for (std::size_t colour = 0; colour < kColours; ++colour) {
      for (const Block& block : blocks_[colour]) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          if (block.a[lane] == block.b[lane]) continue; // the empty half
          visit(PileContact{block.a[lane], block.b[lane], block.nx[lane], block.ny[lane], block.gap[lane],
                            block.share[lane], block.impulse[lane]});
        }
      }
    }
  }

private:
  static constexpr std::size_t kLanes = 2;
  static constexpr std::size_t kColours = 32;
  static constexpr std::size_t kLast = kColours - 1; ///< the colour of one after the other

  /// Two contacts, value by value.
  struct Block {
    std::array<std::uint32_t, kLanes> a, b;
    std::array<double, kLanes> nx, ny, gap, share, impulse;
  };
  template <bool Pushes>
  void sweep(std::span<SlotState> states, double h, const Softness& softness);

  std::array<std::vector<Block>, kColours> blocks_;
  std::array<std::uint32_t, kColours> filled_{}; ///< by colour: contacts
  std::vector<std::uint32_t> used_;              ///< by slot: a bit for each colour that it occurs in
};

} // namespace offstage
