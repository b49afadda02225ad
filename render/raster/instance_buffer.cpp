#include "render/raster/instance_buffer.h"

#include <algorithm>
#include <cstddef>

namespace offstage {
namespace {

constexpr std::size_t kFirstCapacity = 256;
constexpr GLuint kAttributeCount = 8; // the locations in shader_sources.cpp

} // namespace

InstanceBuffer::InstanceBuffer(const GlFunctions& gl) : gl_(gl) {
  gl_.genBuffers(1, &buffer_);
  gl_.bindBuffer(GL_ARRAY_BUFFER, buffer_);
  for (GLuint* vertexArray : {&points_, &quads_}) {
    gl_.genVertexArrays(1, vertexArray);
    gl_.bindVertexArray(*vertexArray);
    for (GLuint location = 0; location < kAttributeCount; ++location) {
      gl_.enableVertexAttribArray(location);
      gl_.vertexAttribDivisor(location, vertexArray == &quads_ ? 1 : 0);
    }
    setAttributes(0);
  }
}

InstanceBuffer::~InstanceBuffer() {
  gl_.deleteBuffers(1, &buffer_);
  gl_.deleteVertexArrays(1, &points_);
  gl_.deleteVertexArrays(1, &quads_);
}

void InstanceBuffer::fillVector() {
  while (instances_.size() % kVector != 0) instances_.emplace_back();
}

void InstanceBuffer::upload() {
  if (instances_.empty()) return;
  gl_.bindBuffer(GL_ARRAY_BUFFER, buffer_);
  if (instances_.size() > capacity_) {
    capacity_ = std::max({instances_.size(), 2 * capacity_, kFirstCapacity});
    gl_.bufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_ * sizeof(Instance)), nullptr,
                   GL_STREAM_DRAW);
  }
  gl_.bufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(instances_.size() * sizeof(Instance)),
                    instances_.data());
}

void InstanceBuffer::draw(Footprint footprint, std::size_t first, std::size_t count) const {
  if (footprint == Footprint::Point) {
    const std::size_t filled = (count + kVector - 1) / kVector * kVector;
    gl_.bindVertexArray(points_);
    gl_.drawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(filled));
    return;
  }
  gl_.bindVertexArray(quads_);
  gl_.bindBuffer(GL_ARRAY_BUFFER, buffer_);
  setAttributes(first); // GL 3.3 draws from the first instance only
  gl_.drawArraysInstanced(GL_TRIANGLE_STRIP, 0, kVector, static_cast<GLsizei>(count));
}

void InstanceBuffer::setAttributes(std::size_t first) const {
  const auto at = [&](std::size_t member) {
    // GL takes offsets as pointers. NOLINTNEXTLINE(performance-no-int-to-ptr)
    return reinterpret_cast<const void*>(first * sizeof(Instance) + member);
  };
  constexpr GLsizei kStride = sizeof(Instance);
  gl_.vertexAttribIPointer(0, 4, GL_UNSIGNED_SHORT, kStride, at(offsetof(Instance, quad)));
  gl_.vertexAttribIPointer(1, 2, GL_SHORT, kStride, at(offsetof(Instance, origin)));
  gl_.vertexAttribIPointer(2, 4, GL_UNSIGNED_BYTE, kStride, at(offsetof(Instance, color)));
  gl_.vertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, outer)));
  gl_.vertexAttribPointer(4, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, inner)));
  gl_.vertexAttribIPointer(5, 4, GL_INT, kStride, at(offsetof(Instance, texels)));
  gl_.vertexAttribPointer(6, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, texelMap)));
  gl_.vertexAttribPointer(7, 2, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, window)));
}

} // namespace offstage
