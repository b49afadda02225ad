#include "render/raster/gl_functions.h"

#include "src/sim/error.h"

#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

template <typename Function>
Function lookUp(const GlContext& context, const char* name) {
  const GlContext::Proc proc = context.proc(name);
  if (proc == nullptr) {
    throw Error(ExitCode::Environment,
                fmt::format("{} gives no {}: OpenGL 3.3 core is needed", context.backend(), name));
  }
  return reinterpret_cast<Function>(proc); // GL hands out every function as one type
}

} // namespace

GlFunctions loadGlFunctions(const GlContext& context) {
  GlFunctions gl;
#define OFFSTAGE_GL_LOAD(member, name, type) gl.member = lookUp<type>(context, name);
  OFFSTAGE_GL_FUNCTIONS(OFFSTAGE_GL_LOAD)
#undef OFFSTAGE_GL_LOAD
  return gl;
}

void checkGl(const GlFunctions& gl, const char* doing) {
  const GLenum error = gl.getError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) {
    throw Error(ExitCode::Transient, fmt::format("OpenGL ran out of memory while {}", doing));
  }
  throw Error(ExitCode::Environment, fmt::format("OpenGL error 0x{:04x} while {}", error, doing));
}

} // namespace offstage
