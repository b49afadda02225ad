#pragma once

#include "render/raster/batch_planner.h"
#include "render/raster/instance_buffer.h"
#include "render/raster/pattern_texture.h"
#include "render/raster/shaders.h"
#include "render/raster/tile_order.h"

#include <vector>

namespace offstage {

/// What is to be drawn, in order, in as few draw calls as that order allows. Memory is kept from frame to
/// frame.
class DrawQueue {
public:
  /// width, height: of the framebuffer in px.
  DrawQueue(const GlFunctions& gl, int width, int height)
      : gl_(gl), buffer_(gl), shaders_(gl, width, height), planner_(width, height), order_(width, height) {}

  void clear();
  void add(const ProgramKind& program, const Instance& instance);
  /// Draws everything into the bound framebuffer. `blendAll`: also what programs would replace.
  void paint(const PatternTexture& patterns, bool blendAll = false);

private:
  /// Consecutive instances of the buffer that one draw call paints.
  struct Batch {
    ProgramKind program;
    std::size_t first;
    std::size_t count;
  };

  void fillBuffer();
  void setBlending(bool on) const;

  const GlFunctions& gl_;
  std::vector<ProgramKind> programs_; ///< one an instance
  std::vector<Instance> instances_;
  InstanceBuffer buffer_;
  Shaders shaders_;
  BatchPlanner planner_;
  TileOrder order_;
  std::vector<Batch> batches_;
};

} // namespace offstage
