#pragma once

#include "render/raster/context.h"
#include "render/raster/gl_functions.h"

#include <memory>
#include <string>

namespace offstage {

/// The process's GL context with its functions and limits. Canvases share it, so that several may live at a
/// time, each with a framebuffer of its own.
class GlDevice {
public:
  /// The present device, or a new one when no canvas holds one. Throws as makeGlContext(), and
  /// std::logic_error when the device was made by another process (before a fork) or another thread.
  static std::shared_ptr<GlDevice> shared();

  explicit GlDevice(std::unique_ptr<GlContext> context);

  [[nodiscard]] const GlFunctions& gl() const { return gl_; }
  [[nodiscard]] std::string backend() const { return context_->backend(); }
  [[nodiscard]] std::string text(GLenum name) const;               ///< glGetString
  [[nodiscard]] int maxSize() const { return maxSize_; }           ///< px a side of a framebuffer
  [[nodiscard]] int largestPoint() const { return largestPoint_; } ///< px a side of GL_POINTS
  [[nodiscard]] int maxTexels() const { return maxTexels_; }       ///< of a buffer texture

private:
  std::unique_ptr<GlContext> context_;
  GlFunctions gl_;
  int maxSize_ = 0;
  int largestPoint_ = 0;
  int maxTexels_ = 0;
};

} // namespace offstage
