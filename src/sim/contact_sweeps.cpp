// The sweeps of ContactBlocks over its contacts, two or four at a time. Both do the same operations on each,
// and none of them is contracted, so that their bits are the same.
#include "src/sim/contact_blocks.h"
#include "src/sim/two.h"

#if defined(__x86_64__)
#define OFFSTAGE_WIDE __attribute__((target("avx2")))
#else
#define OFFSTAGE_WIDE
#endif

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

/// Four doubles side by side. Only in functions that are OFFSTAGE_WIDE: others would have to take it apart.
using Four = double __attribute__((vector_size(32)));

OFFSTAGE_WIDE inline void loadFour(const double* values, Four& four) {
  std::memcpy(&four, values, sizeof four);
}

/// The states of one body of each of four contacts.
struct FourStates {
  Four vx, vy, x, y;
};

OFFSTAGE_WIDE inline void loadFour(const SlotState& s0, const SlotState& s1, const SlotState& s2,
                                   const SlotState& s3, FourStates& states) {
  Four r0, r1, r2, r3;
  loadFour(&s0.vx, r0);
  loadFour(&s1.vx, r1);
  loadFour(&s2.vx, r2);
  loadFour(&s3.vx, r3);
  const Four low01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
  const Four high01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
  const Four low23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
  const Four high23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
  states.vx = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  states.vy = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  states.x = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  states.y = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

OFFSTAGE_WIDE inline void storeVelocities(const Four& vx, const Four& vy, SlotState& s0, SlotState& s1,
                                          SlotState& s2, SlotState& s3) {
  const Four even = __builtin_shufflevector(vx, vy, 0, 4, 2, 6);
  const Four odd = __builtin_shufflevector(vx, vy, 1, 5, 3, 7);
  store(&s0.vx, __builtin_shufflevector(even, even, 0, 1));
  store(&s1.vx, __builtin_shufflevector(odd, odd, 0, 1));
  store(&s2.vx, __builtin_shufflevector(even, even, 2, 3));
  store(&s3.vx, __builtin_shufflevector(odd, odd, 2, 3));
}

} // namespace

template <bool Even>
void ContactBlocks::warmStartRun(const Run& run, SlotState* states) {
  for (std::size_t i = 0; i < run.count * kLanes; i += 2) {
    const Block& block = run.blocks[i / kLanes];
    const std::size_t lane = i % kLanes;
    SlotState& a0 = states[block.a[lane]];
    SlotState& a1 = states[block.a[lane + 1]];
    SlotState& b0 = states[block.b[lane]];
    SlotState& b1 = states[block.b[lane + 1]];
    const Two share =
        Even ? Two{evenShare(block.b[lane], run.outside), evenShare(block.b[lane + 1], run.outside)}
             : load(&run.shares[i / kLanes][lane]);
    const Two impulse = load(&block.impulse[lane]);
    const Two ofA = share * impulse;
    const Two ofB = impulse - ofA;
    const Two nx = load(&block.nx[lane]);
    const Two ny = load(&block.ny[lane]);
    const TwoVectors va = velocities(a0, a1);
    setVelocities(a0, a1, {va.x - ofA * nx, va.y - ofA * ny});
    const TwoVectors vb = velocities(b0, b1);
    setVelocities(b0, b1, {vb.x + ofB * nx, vb.y + ofB * ny});
  }
}

void ContactBlocks::warmStart(std::span<SlotState> states) {
  forEachChunk([&](std::uint32_t chunk, std::uint32_t count) {
    even_ ? warmStartRun<true>(runOf(chunk, count), states.data())
          : warmStartRun<false>(runOf(chunk, count), states.data());
  });
}

template <bool Pushes, bool Even>
void ContactBlocks::sweepByTwo(const Run& run, SlotState* states, double perStep, const Softness& softness) {
  for (std::size_t i = 0; i < run.count * kLanes; i += 2) {
    Block& block = run.blocks[i / kLanes];
    const std::size_t lane = i % kLanes;
    SlotState& a0 = states[block.a[lane]];
    SlotState& a1 = states[block.a[lane + 1]];
    SlotState& b0 = states[block.b[lane]];
    SlotState& b1 = states[block.b[lane + 1]];
    const TwoVectors pa = places(a0, a1);
    const TwoVectors pb = places(b0, b1);
    const TwoVectors va = velocities(a0, a1);
    const TwoVectors vb = velocities(b0, b1);
    const Two nx = load(&block.nx[lane]);
    const Two ny = load(&block.ny[lane]);
    const Two gap = ((pb.x - pa.x) * nx + (pb.y - pa.y) * ny) - load(&block.touch[lane]);
    const Two vn = (vb.x - va.x) * nx + (vb.y - va.y) * ny;
    const Two old = load(&block.impulse[lane]);
    const Two zero{};
    const auto open = gap > zero;
    // An open gap may close, no more: a speed of gap/h.
    Two wanted;
    if constexpr (Pushes) {
      const Two hard = vn + gap * perStep;
      const Two soft = (vn + gap * softness.rate) * softness.mass + old * softness.impulse;
      wanted = old - (open ? hard : soft);
    } else {
      wanted = old - (vn + (open ? gap * perStep : zero));
    }
    const Two impulse = wanted > zero ? wanted : zero; // contacts never pull; NaN becomes 0
    store(&block.impulse[lane], impulse);
    const Two change = impulse - old;
    const Two share =
        Even ? Two{evenShare(block.b[lane], run.outside), evenShare(block.b[lane + 1], run.outside)}
             : load(&run.shares[i / kLanes][lane]);
    const Two ofA = share * change;
    const Two ofB = change - ofA;
    setVelocities(a0, a1, {va.x - ofA * nx, va.y - ofA * ny});
    setVelocities(b0, b1, {vb.x + ofB * nx, vb.y + ofB * ny});
  }
}

template <bool Pushes, bool Even>
OFFSTAGE_WIDE void ContactBlocks::sweepByFour(const Run& run, SlotState* states, double perStep,
                                              const Softness& softness) {
  static_assert(kLanes == 4 && sizeof(SlotState) == sizeof(Four));
  const Four zero{};
  for (std::uint32_t i = 0; i < run.count; ++i) {
    Block* const block = run.blocks + i;
    SlotState& a0 = states[block->a[0]];
    SlotState& a1 = states[block->a[1]];
    SlotState& a2 = states[block->a[2]];
    SlotState& a3 = states[block->a[3]];
    SlotState& b0 = states[block->b[0]];
    SlotState& b1 = states[block->b[1]];
    SlotState& b2 = states[block->b[2]];
    SlotState& b3 = states[block->b[3]];
    FourStates a, b;
    loadFour(a0, a1, a2, a3, a);
    loadFour(b0, b1, b2, b3, b);
    Four nx, ny, touch, share, old;
    loadFour(block->nx.data(), nx);
    loadFour(block->ny.data(), ny);
    loadFour(block->touch.data(), touch);
    if constexpr (Even) {
      using Indices = std::uint32_t __attribute__((vector_size(16)));
      using Masks = std::int32_t __attribute__((vector_size(16)));
      using WideMasks = std::int64_t __attribute__((vector_size(32)));
      Indices others;
      std::memcpy(&others, block->b.data(), sizeof others);
      const WideMasks fixed =
          __builtin_convertvector(reinterpret_cast<Masks>(others == run.outside), WideMasks);
      share = fixed ? 1.0 + zero : 0.5 + zero;
    } else {
      loadFour(run.shares[i].data(), share);
    }
    loadFour(block->impulse.data(), old);
    const Four gap = ((b.x - a.x) * nx + (b.y - a.y) * ny) - touch;
    const Four vn = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny;
    const auto open = gap > zero;
    Four wanted;
    if constexpr (Pushes) {
      const Four hard = vn + gap * perStep;
      const Four soft = (vn + gap * softness.rate) * softness.mass + old * softness.impulse;
      wanted = old - (open ? hard : soft);
    } else {
      wanted = old - (vn + (open ? gap * perStep : zero));
    }
    const Four impulse = wanted > zero ? wanted : zero;
    std::memcpy(block->impulse.data(), &impulse, sizeof impulse);
    const Four change = impulse - old;
    const Four ofA = share * change;
    const Four ofB = change - ofA;
    storeVelocities(a.vx - ofA * nx, a.vy - ofA * ny, a0, a1, a2, a3);
    storeVelocities(b.vx + ofB * nx, b.vy + ofB * ny, b0, b1, b2, b3);
  }
}

template <bool Pushes, bool Even>
void ContactBlocks::sweep(std::span<SlotState> states, double h, const Softness& softness) {
  const double perStep = 1.0 / h;
  forEachChunk([&](std::uint32_t chunk, std::uint32_t count) {
    const Run run = runOf(chunk, count);
    if (wide_) {
      sweepByFour<Pushes, Even>(run, states.data(), perStep, softness);
    } else {
      sweepByTwo<Pushes, Even>(run, states.data(), perStep, softness);
    }
  });
}

void ContactBlocks::solve(std::span<SlotState> states, double h, const Softness& softness) {
  even_ ? sweep<true, true>(states, h, softness) : sweep<true, false>(states, h, softness);
}

void ContactBlocks::relax(std::span<SlotState> states, double h) {
  even_ ? sweep<false, true>(states, h, {}) : sweep<false, false>(states, h, {});
}

} // namespace offstage
