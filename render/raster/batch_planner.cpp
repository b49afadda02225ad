#include "render/raster/batch_planner.h"

#include <algorithm>

namespace offstage {

BatchPlanner::BatchPlanner(int width, int height)
    : columns_((width + kCell - 1) / kCell),
      last_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>((height + kCell - 1) / kCell)) {}

std::span<const BatchPlanner::Batch> BatchPlanner::plan(const std::vector<ProgramKind>& programs,
                                                        const std::vector<Instance>& instances) {
  used_ = 0;
  if (programs.empty()) return {};
  const bool single = std::all_of(programs.begin(), programs.end(),
                                  [&](const ProgramKind& program) { return program == programs.front(); });
  if (!single) std::fill(last_.begin(), last_.end(), -1);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    if (single) {
      (i == 0 ? open(programs[i]) : batches_.front()).members.push_back(index);
      continue;
    }
    const std::int32_t under = lastBatchUnder(instances[i]);
    auto batch = static_cast<std::size_t>(std::max(under, 0));
    while (batch < used_ && batches_[batch].program != programs[i]) ++batch;
    (batch < used_ ? batches_[batch] : open(programs[i])).members.push_back(index);
    mark(instances[i], static_cast<std::int32_t>(batch));
  }
  return std::span<const Batch>(batches_).first(used_);
}

template <typename Visit>
void BatchPlanner::visitCells(const Instance& instance, Visit visit) const {
  const int left = instance.quad[0] / kCell;
  const int right = (instance.quad[2] + kCell - 1) / kCell;
  const int bottom = (instance.quad[3] + kCell - 1) / kCell;
  for (int row = instance.quad[1] / kCell; row < bottom; ++row) {
    const std::size_t line = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    for (int column = left; column < right; ++column) visit(line + static_cast<std::size_t>(column));
  }
}

std::int32_t BatchPlanner::lastBatchUnder(const Instance& instance) const {
  std::int32_t batch = -1;
  visitCells(instance, [&](std::size_t cell) { batch = std::max(batch, last_[cell]); });
  return batch;
}

void BatchPlanner::mark(const Instance& instance, std::int32_t batch) {
  visitCells(instance, [&](std::size_t cell) { last_[cell] = batch; });
}

BatchPlanner::Batch& BatchPlanner::open(const ProgramKind& program) {
  if (used_ == batches_.size()) batches_.emplace_back();
  Batch& batch = batches_[used_++];
  batch.program = program;
  batch.members.clear();
  return batch;
}

} // namespace offstage
