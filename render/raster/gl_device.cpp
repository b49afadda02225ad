#include "render/raster/gl_device.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <thread>
#include <unistd.h>

namespace offstage {
namespace {

/// The largest canvas: the frame's coordinates fit into the instances' 16-bit integers.
constexpr int kLargestSide = 16384;

} // namespace

std::shared_ptr<GlDevice> GlDevice::shared() {
  static std::weak_ptr<GlDevice> present;
  static pid_t process = 0;
  static std::thread::id thread;
  if (std::shared_ptr<GlDevice> device = present.lock()) {
    if (process != getpid() || thread != std::this_thread::get_id()) {
      throw std::logic_error("a canvas was made while another process or thread still holds the GL context");
    }
    return device;
  }
  auto device = std::make_shared<GlDevice>(makeGlContext());
  present = device;
  process = getpid();
  thread = std::this_thread::get_id();
  return device;
}

GlDevice::GlDevice(std::unique_ptr<GlContext> context)
    : context_(std::move(context)), gl_(loadGlFunctions(*context_)) {
  GLint renderbuffer = 0;
  std::array<GLint, 2> viewport{};
  gl_.getIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
  gl_.getIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  gl_.getIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &maxTexels_);
  std::array<GLfloat, 2> pointSizes{};
  gl_.getFloatv(GL_POINT_SIZE_RANGE, pointSizes.data());
  largestPoint_ = static_cast<int>(pointSizes[1]);
  maxSize_ = std::min({renderbuffer, viewport[0], viewport[1], kLargestSide});
  checkGl(gl_, "reading its limits");
}

std::string GlDevice::text(GLenum name) const {
  const GLubyte* value = gl_.getString(name);
  return value != nullptr ? reinterpret_cast<const char*>(value) : "";
}

} // namespace offstage
