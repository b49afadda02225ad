#pragma once

#include "render/raster/instance.h"
#include "render/raster/shader_sources.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Sorts instances into batches of one program each. Changing the program costs llvmpipe about as much as
/// four circles do, so instances join an earlier batch of their program wherever nothing that they overlap
/// was drawn since: among instances whose bounds overlap the order stays.
class BatchPlanner {
public:
  struct Batch {
    ProgramKind program{};
    std::vector<std::uint32_t> members; ///< indices of instances, ascending
  };

  /// width, height: of the framebuffer in px.
  BatchPlanner(int width, int height);

  /// Batches in the order in which to draw them. One program for each instance. Valid until the next call.
  std::span<const Batch> plan(const std::vector<ProgramKind>& programs,
                              const std::vector<Instance>& instances);

private:
  [[nodiscard]] std::int32_t lastBatchUnder(const Instance& instance) const;
  void mark(const Instance& instance, std::int32_t batch);
  Batch& open(const ProgramKind& program);
  template <typename Visit>
  void visitCells(const Instance& instance, Visit visit) const;

  static constexpr int kCell = 16; ///< px
  int columns_;
  std::vector<std::int32_t> last_; ///< of each cell: the last batch that draws there, or −1
  std::vector<Batch> batches_;     ///< those beyond used_ only keep their memory
  std::size_t used_ = 0;
};

} // namespace offstage
