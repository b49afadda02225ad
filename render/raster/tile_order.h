#pragma once

#include "render/raster/instance.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Sorts the instances of a large batch by the part of the frame that they lie in. llvmpipe shades a frame in
/// tiles of 64×64 px and reads of each instance there what it has set up before; what lies together in memory
/// then comes sooner than what lies apart (a frame of 10,000 discs at 1080p in 10.2 ms instead of 11.4).
/// Among instances whose bounds overlap the order stays, so the pixels do.
class TileOrder {
public:
  /// Batches smaller than this stay as they are: what llvmpipe sets up for them fits into the processor's
  /// cache.
  static constexpr std::size_t kLargeBatch = 2048;

  /// width, height: of the framebuffer in px.
  TileOrder(int width, int height);

  /// `members`, indices of instances in drawing order, in the order in which to draw them. Valid until the
  /// next call and as long as `members`.
  [[nodiscard]] std::span<const std::uint32_t> sorted(std::span<const std::uint32_t> members,
                                                      const std::vector<Instance>& instances);

private:
  [[nodiscard]] std::uint32_t place(const Instance& instance);
  [[nodiscard]] std::uint32_t tileOf(const Instance& instance) const;
  template <typename Visit>
  void visitCells(const Instance& instance, Visit visit);

  static constexpr int kTile = 64; ///< px: llvmpipe's
  static constexpr int kCell = 8;  ///< px: two instances that touch the same cell count as overlapping
  int tileColumns_;
  int cellColumns_;
  std::size_t tiles_;
  std::size_t cells_;
  std::vector<std::uint32_t> last_;   ///< of each cell: the tile that the last instance there is drawn with
  std::vector<std::uint32_t> with_;   ///< of each member: the tile that it is drawn with
  std::vector<std::uint32_t> begins_; ///< of each tile: where its next member goes
  std::vector<std::uint32_t> sorted_;
};

} // namespace offstage
