#include "render/raster/draw_queue.h"

#include <algorithm>

namespace offstage {

void DrawQueue::clear() {
  programs_.clear();
  instances_.clear();
}

void DrawQueue::add(const ProgramKind& program, const Instance& instance) {
  programs_.push_back(program);
  instances_.push_back(instance);
}

void DrawQueue::paint(const PatternTexture& patterns, bool blendAll) {
  if (instances_.empty()) return;
  fillBuffer();
  buffer_.upload();
  patterns.bind();
  gl_.enable(GL_PROGRAM_POINT_SIZE);
  for (const Batch& batch : batches_) {
    setBlending(blendAll || !replaces(batch.program.coverage));
    shaders_.use(batch.program);
    buffer_.draw(batch.program.footprint, batch.first, batch.count);
  }
}

/// Puts the instances into the buffer, batch after batch.
void DrawQueue::fillBuffer() {
  buffer_.clear();
  batches_.clear();
  for (const BatchPlanner::Batch& planned : planner_.plan(programs_, instances_)) {
    const std::size_t first = buffer_.size();
    for (const std::uint32_t i : order_.sorted(planned.members, instances_)) buffer_.add(instances_[i]);
    batches_.push_back({planned.program, first, planned.members.size()});
    buffer_.fillVector();
  }
}

void DrawQueue::setBlending(bool on) const {
  if (on) {
    gl_.enable(GL_BLEND);
    gl_.blendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // premultiplied source over premultiplied framebuffer
  } else {
    gl_.disable(GL_BLEND);
  }
}

} // namespace offstage
