#include "render/raster/shaders.h"

#include "src/sim/error.h"

#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

using Log = std::array<char, 2048>;

GLuint compile(const GlFunctions& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.createShader(stage);
  const char* text = source.c_str();
  gl.shaderSource(shader, 1, &text, nullptr);
  gl.compileShader(shader);
  GLint compiled = GL_FALSE;
  gl.getShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  Log log{};
  gl.getShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  gl.deleteShader(shader);
  throw Error(ExitCode::Environment, fmt::format("OpenGL does not compile a shader: {}", log.data()));
}

std::size_t indexOf(const ProgramKind& kind) {
  const auto coverage = static_cast<std::size_t>(kind.coverage);
  const auto paint = static_cast<std::size_t>(kind.paint);
  return (coverage * kPaintSourceCount + paint) * kFootprintCount + static_cast<std::size_t>(kind.footprint);
}

} // namespace

Shaders::Shaders(const GlFunctions& gl, int width, int height) : gl_(gl), width_(width), height_(height) {}

Shaders::~Shaders() {
  for (const GLuint program : programs_) gl_.deleteProgram(program); // 0 is ignored
}

void Shaders::use(const ProgramKind& kind) {
  GLuint& program = programs_.at(indexOf(kind));
  if (program == 0) program = build(kind);
  gl_.useProgram(program);
}

GLuint Shaders::build(const ProgramKind& kind) const {
  const GLuint vertex = compile(gl_, GL_VERTEX_SHADER, vertexSource(kind));
  GLuint fragment = 0;
  try {
    fragment = compile(gl_, GL_FRAGMENT_SHADER, fragmentSource(kind));
  } catch (...) {
    gl_.deleteShader(vertex);
    throw;
  }
  const GLuint program = gl_.createProgram();
  gl_.attachShader(program, vertex);
  gl_.attachShader(program, fragment);
  gl_.linkProgram(program);
  gl_.deleteShader(vertex); // the program keeps it
  gl_.deleteShader(fragment);
  GLint linked = GL_FALSE;
  gl_.getProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    Log log{};
    gl_.getProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl_.deleteProgram(program);
    throw Error(ExitCode::Environment, fmt::format("OpenGL does not link a program: {}", log.data()));
  }
  gl_.useProgram(program);
  gl_.uniform2f(gl_.getUniformLocation(program, "clipPerPixel"), 2.0F / static_cast<float>(width_),
                2.0F / static_cast<float>(height_));
  return program;
}

} // namespace offstage
