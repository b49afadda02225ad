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
  /// Adds instances that draw nothing until size() is a multiple of kVector. Ends every run that draw() is
  /// given: Mesa 22.3 shades vertices in such groups, and with LP_NATIVE_VECTOR_WIDTH=128 on a processor that
  /// has more than AVX it writes past its memory when a group is not full.
  void fillVector();
  [[nodiscard]] std::size_t size() const { return instances_.size(); }

  void upload(); ///< to GL
  /// Draws `count` instances from `first` with the current program, in order.
  void draw(Footprint footprint, std::size_t first, std::size_t count) const;

  static constexpr std::size_t kVector = 8; ///< vertices

private:
  void setAttributes(std::size_t first) const; ///< of the bound vertex array and buffer

  const GlFunctions& gl_;
  std::vector<Instance> instances_;
  GLuint points_ = 0; ///< vertex array: an instance a vertex
  GLuint quads_ = 0;  ///< vertex array: an instance every kVector vertices
  GLuint buffer_ = 0;
  std::size_t capacity_ = 0; ///< instances that the GL buffer holds
};

} // namespace offstage
