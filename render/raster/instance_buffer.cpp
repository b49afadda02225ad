#include "render/raster/instance_buffer.h"

#include <algorithm>
#include <cstddef>

namespace offstage {
namespace {

constexpr std::size_t kFirstCapacity = 256;
constexpr GLuint kAttributeCount = 8; // the locations in shaders.cpp

} // namespace

InstanceBuffer::InstanceBuffer(const GlFunctions& gl) : gl_(gl) {
  gl_.genVertexArrays(1, &vertexArray_);
  gl_.genBuffers(1, &buffer_);
  gl_.bindVertexArray(vertexArray_);
  for (GLuint location = 0; location < kAttributeCount; ++location) {
    gl_.enableVertexAttribArray(location);
    gl_.vertexAttribDivisor(location, 1);
  }
}

InstanceBuffer::~InstanceBuffer() {
  gl_.deleteBuffers(1, &buffer_);
  gl_.deleteVertexArrays(1, &vertexArray_);
}

void InstanceBuffer::upload() {
  gl_.bindVertexArray(vertexArray_);
  gl_.bindBuffer(GL_ARRAY_BUFFER, buffer_);
  if (instances_.size() > capacity_) {
    capacity_ = std::max({instances_.size(), 2 * capacity_, kFirstCapacity});
    gl_.bufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_ * sizeof(Instance)), nullptr,
                   GL_STREAM_DRAW);
  }
  if (instances_.empty()) return;
  gl_.bufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(instances_.size() * sizeof(Instance)),
                    instances_.data());
}

void InstanceBuffer::draw(std::size_t first, std::size_t count) const {
  const auto at = [&](std::size_t member) {
    return reinterpret_cast<const void*>(first * sizeof(Instance) + member); // an offset, by GL's convention
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
  gl_.drawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
}

} // namespace offstage
