#include "src/sim/contact_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace offstage {
namespace {

/// Two doubles that go through the same operations side by side, each rounded by itself as IEEE 754 says.
using Two = double __attribute__((vector_size(16)));

Two load(const double* values) {
  Two two;
  std::memcpy(&two, values, sizeof two);
  return two;
}

void store(double* values, const Two& two) {
  std::memcpy(values, &two, sizeof two);
}

/// The velocities of one body of each of two contacts.
struct TwoVectors {
  Two x, y;
};

TwoVectors turned(const Two& first, const Two& second) {
  return {__builtin_shufflevector(first, second, 0, 2), __builtin_shufflevector(first, second, 1, 3)};
}

TwoVectors velocities(const SlotState& first, const SlotState& second) {
  return turned(load(&first.vx), load(&second.vx));
}

TwoVectors moves(const SlotState& first, const SlotState& second) {
  return turned(load(&first.dx), load(&second.dx));
}

void setVelocities(SlotState& first, SlotState& second, const TwoVectors& velocities) {
  const TwoVectors rows = turned(velocities.x, velocities.y);
  store(&first.vx, rows.x);
  store(&second.vx, rows.y);
}

} // namespace

void ContactBlocks::begin(std::size_t slots) {
  for (auto& blocks : blocks_) blocks.clear();
  filled_.fill(0);
  used_.assign(slots, 0U);
}

ContactBlocks::Place ContactBlocks::add(const PileContact& contact) {
  // A fixed body takes no part of a velocity change, so it may occur any number of times.
  std::uint32_t taken = 0;
  if (contact.share != 0.0) taken |= used_[contact.a];
  if (contact.share != 1.0) taken |= used_[contact.b];
  const auto colour = std::min<std::size_t>(static_cast<std::size_t>(std::countr_one(taken)), kLast);
  const std::uint32_t bit = 1U << colour;
  if (contact.share != 0.0) used_[contact.a] |= bit;
  if (contact.share != 1.0) used_[contact.b] |= bit;

  auto& blocks = blocks_[colour];
  std::uint32_t& index = filled_[colour];
  const std::size_t lane = index % kLanes;
  if (lane == 0) {
    const auto nobody = static_cast<std::uint32_t>(used_.size());
    Block empty{};
    empty.a.fill(nobody);
    empty.b.fill(nobody);
    blocks.push_back(empty);
  }
  Block& block = blocks.back();
  block.a[lane] = contact.a;
  block.b[lane] = contact.b;
  block.nx[lane] = contact.nx;
  block.ny[lane] = contact.ny;
  block.gap[lane] = contact.gap;
  block.share[lane] = contact.share;
  block.impulse[lane] = contact.impulse;
  const Place place{static_cast<std::uint32_t>(colour), index};
  index += colour == kLast ? std::uint32_t{kLanes} : 1U;
  return place;
}

double ContactBlocks::impulse(Place place) const {
  return blocks_[place.colour][place.index / kLanes].impulse[place.index % kLanes];
}

void ContactBlocks::setImpulse(Place place, double impulse) {
  blocks_[place.colour][place.index / kLanes].impulse[place.index % kLanes] = impulse;
}

void ContactBlocks::warmStart(std::span<SlotState> states) const {
  for (const auto& blocks : blocks_) {
    for (const Block& block : blocks) {
      SlotState& a0 = states[block.a[0]];
      SlotState& a1 = states[block.a[1]];
      SlotState& b0 = states[block.b[0]];
      SlotState& b1 = states[block.b[1]];
      const Two impulse = load(block.impulse.data());
      const Two ofA = load(block.share.data()) * impulse;
      const Two ofB = impulse - ofA;
      const Two nx = load(block.nx.data());
      const Two ny = load(block.ny.data());
      const TwoVectors va = velocities(a0, a1);
      setVelocities(a0, a1, {va.x - ofA * nx, va.y - ofA * ny});
      const TwoVectors vb = velocities(b0, b1);
      setVelocities(b0, b1, {vb.x + ofB * nx, vb.y + ofB * ny});
    }
  }
}

template <bool Pushes>
void ContactBlocks::sweep(std::span<SlotState> states, double h, const Softness& softness) {
  const double perStep = 1.0 / h;
  for (auto& blocks : blocks_) {
    for (Block& block : blocks) {
      SlotState& a0 = states[block.a[0]];
      SlotState& a1 = states[block.a[1]];
      SlotState& b0 = states[block.b[0]];
      SlotState& b1 = states[block.b[1]];
      const TwoVectors da = moves(a0, a1);
      const TwoVectors db = moves(b0, b1);
      const TwoVectors va = velocities(a0, a1);
      const TwoVectors vb = velocities(b0, b1);
      const Two nx = load(block.nx.data());
      const Two ny = load(block.ny.data());
      const Two gap = load(block.gap.data()) + ((db.x - da.x) * nx + (db.y - da.y) * ny);
      const Two vn = (vb.x - va.x) * nx + (vb.y - va.y) * ny;
      const Two old = load(block.impulse.data());
      const Two zero{};
      const auto open = gap > zero;
      // An open gap may close, no more: a speed of gap/h.
      Two wanted;
      if constexpr (Pushes) {
        const Two hard = (vn + gap * perStep);
        const Two soft = (vn + gap * softness.rate) * softness.mass + old * softness.impulse;
        wanted = old - (open ? hard : soft);
      } else {
        wanted = old - (vn + (open ? gap * perStep : zero));
      }
      const Two impulse = wanted > zero ? wanted : zero; // contacts never pull; NaN becomes 0
      store(block.impulse.data(), impulse);
      const Two change = impulse - old;
      const Two ofA = load(block.share.data()) * change;
      const Two ofB = change - ofA;
      setVelocities(a0, a1, {va.x - ofA * nx, va.y - ofA * ny});
      setVelocities(b0, b1, {vb.x + ofB * nx, vb.y + ofB * ny});
    }
  }
}

void ContactBlocks::solve(std::span<SlotState> states, double h, const Softness& softness) {
  sweep<true>(states, h, softness);
}

void ContactBlocks::relax(std::span<SlotState> states, double h) {
  sweep<false>(states, h, {});
}

} // namespace offstage
