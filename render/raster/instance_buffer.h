#pragma once

#include "render/raster/gl_functions.h"
#include "render/raster/instance.h"

#include <vector>

namespace offstage {

/// The instances of a frame, and their copy in a GL buffer that grows and is then reused.
class InstanceBuffer {
public:
  explicit InstanceBuffer(const GlFunctions& gl);
  ~InstanceBuffer();
  InstanceBuffer(const InstanceBuffer&) = delete;
  InstanceBuffer& operator=(const InstanceBuffer&) = delete;

  void clear() { instances_.clear(); } ///< keeps the memory
  void add(const Instance& instance) { instances_.push_back(instance); }
  [[nodiscard]] std::size_t size() const { return instances_.size(); }

  void upload(); ///< to GL; binds the vertex array
  /// Draws `count` instances from `first` with the current program, one quad each, in order.
  void draw(std::size_t first, std::size_t count) const;

private:
  const GlFunctions& gl_;
  std::vector<Instance> instances_;
  GLuint vertexArray_ = 0;
  GLuint buffer_ = 0;
  std::size_t capacity_ = 0; ///< instances that the GL buffer holds
};

} // namespace offstage
