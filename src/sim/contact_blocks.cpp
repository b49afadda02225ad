#include "src/sim/contact_blocks.h"

#include "src/sim/two.h"

#include <algorithm>

namespace offstage {
namespace {

TwoVectors velocities(const SlotState& first, const SlotState& second) {
  return turned(load(&first.vx), load(&second.vx));
}

TwoVectors places(const SlotState& first, const SlotState& second) {
  return turned(load(&first.x), load(&second.x));
}

void setVelocities(SlotState& first, SlotState& second, const TwoVectors& velocities) {
  const TwoVectors rows = turned(velocities.x, velocities.y);
  store(&first.vx, rows.x);
  store(&second.vx, rows.y);
}

} // namespace

void ContactBlocks::begin(std::size_t slots) {
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
    const std::size_t more = chunks_.size() / 16 + 4;
    next_.resize(chunks_.size() + more);
    for (std::size_t i = 0; i < more; ++i) chunks_.emplace_back(kBlocks);
  }
  std::fill(chunks_[chunksUsed_].begin(), chunks_[chunksUsed_].end(), empty_);
  next_[chunksUsed_] = kNone;
  (row.first == kNone ? row.first : next_[row.last]) = chunksUsed_;
  row.last = chunksUsed_;
  row.filled = 0;
  ++chunksUsed_;
}

void ContactBlocks::warmStart(std::span<SlotState> states) {
  forEachBlock([&](const Block& block) {
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
  });
}

template <bool Pushes>
void ContactBlocks::sweep(std::span<SlotState> states, double h, const Softness& softness) {
  const double perStep = 1.0 / h;
  forEachBlock([&](Block& block) {
    SlotState& a0 = states[block.a[0]];
    SlotState& a1 = states[block.a[1]];
    SlotState& b0 = states[block.b[0]];
    SlotState& b1 = states[block.b[1]];
    const TwoVectors pa = places(a0, a1);
    const TwoVectors pb = places(b0, b1);
    const TwoVectors va = velocities(a0, a1);
    const TwoVectors vb = velocities(b0, b1);
    const Two nx = load(block.nx.data());
    const Two ny = load(block.ny.data());
    const Two gap = ((pb.x - pa.x) * nx + (pb.y - pa.y) * ny) - load(block.touch.data());
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
  });
}

void ContactBlocks::solve(std::span<SlotState> states, double h, const Softness& softness) {
  sweep<true>(states, h, softness);
}

void ContactBlocks::relax(std::span<SlotState> states, double h) {
  sweep<false>(states, h, {});
}

} // namespace offstage
