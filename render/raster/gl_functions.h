#pragma once

#include "render/raster/context.h"

#include <GL/glcorearb.h>

namespace offstage {

/// The GL 3.3 core functions that the canvas uses: member, GL name, type. One list, so that the table and the
/// loader cannot disagree.
#define OFFSTAGE_GL_FUNCTIONS(X)                                                                             \
  X(attachShader, "glAttachShader", PFNGLATTACHSHADERPROC)                                                   \
  X(bindBuffer, "glBindBuffer", PFNGLBINDBUFFERPROC)                                                         \
  X(bindFramebuffer, "glBindFramebuffer", PFNGLBINDFRAMEBUFFERPROC)                                          \
  X(bindRenderbuffer, "glBindRenderbuffer", PFNGLBINDRENDERBUFFERPROC)                                       \
  X(bindTexture, "glBindTexture", PFNGLBINDTEXTUREPROC)                                                      \
  X(bindVertexArray, "glBindVertexArray", PFNGLBINDVERTEXARRAYPROC)                                          \
  X(blendFunc, "glBlendFunc", PFNGLBLENDFUNCPROC)                                                            \
  X(bufferData, "glBufferData", PFNGLBUFFERDATAPROC)                                                         \
  X(bufferSubData, "glBufferSubData", PFNGLBUFFERSUBDATAPROC)                                                \
  X(checkFramebufferStatus, "glCheckFramebufferStatus", PFNGLCHECKFRAMEBUFFERSTATUSPROC)                     \
  X(clear, "glClear", PFNGLCLEARPROC)                                                                        \
  X(clearColor, "glClearColor", PFNGLCLEARCOLORPROC)                                                         \
  X(compileShader, "glCompileShader", PFNGLCOMPILESHADERPROC)                                                \
  X(copyBufferSubData, "glCopyBufferSubData", PFNGLCOPYBUFFERSUBDATAPROC)                                    \
  X(createProgram, "glCreateProgram", PFNGLCREATEPROGRAMPROC)                                                \
  X(createShader, "glCreateShader", PFNGLCREATESHADERPROC)                                                   \
  X(deleteBuffers, "glDeleteBuffers", PFNGLDELETEBUFFERSPROC)                                                \
  X(deleteFramebuffers, "glDeleteFramebuffers", PFNGLDELETEFRAMEBUFFERSPROC)                                 \
  X(deleteProgram, "glDeleteProgram", PFNGLDELETEPROGRAMPROC)                                                \
  X(deleteRenderbuffers, "glDeleteRenderbuffers", PFNGLDELETERENDERBUFFERSPROC)                              \
  X(deleteShader, "glDeleteShader", PFNGLDELETESHADERPROC)                                                   \
  X(deleteTextures, "glDeleteTextures", PFNGLDELETETEXTURESPROC)                                             \
  X(deleteVertexArrays, "glDeleteVertexArrays", PFNGLDELETEVERTEXARRAYSPROC)                                 \
  X(disable, "glDisable", PFNGLDISABLEPROC)                                                                  \
  X(drawArrays, "glDrawArrays", PFNGLDRAWARRAYSPROC)                                                         \
  X(drawArraysInstanced, "glDrawArraysInstanced", PFNGLDRAWARRAYSINSTANCEDPROC)                              \
  X(enable, "glEnable", PFNGLENABLEPROC)                                                                     \
  X(enableVertexAttribArray, "glEnableVertexAttribArray", PFNGLENABLEVERTEXATTRIBARRAYPROC)                  \
  X(framebufferRenderbuffer, "glFramebufferRenderbuffer", PFNGLFRAMEBUFFERRENDERBUFFERPROC)                  \
  X(genBuffers, "glGenBuffers", PFNGLGENBUFFERSPROC)                                                         \
  X(genFramebuffers, "glGenFramebuffers", PFNGLGENFRAMEBUFFERSPROC)                                          \
  X(genRenderbuffers, "glGenRenderbuffers", PFNGLGENRENDERBUFFERSPROC)                                       \
  X(genTextures, "glGenTextures", PFNGLGENTEXTURESPROC)                                                      \
  X(genVertexArrays, "glGenVertexArrays", PFNGLGENVERTEXARRAYSPROC)                                          \
  X(getError, "glGetError", PFNGLGETERRORPROC)                                                               \
  X(getFloatv, "glGetFloatv", PFNGLGETFLOATVPROC)                                                            \
  X(getIntegerv, "glGetIntegerv", PFNGLGETINTEGERVPROC)                                                      \
  X(getProgramInfoLog, "glGetProgramInfoLog", PFNGLGETPROGRAMINFOLOGPROC)                                    \
  X(getProgramiv, "glGetProgramiv", PFNGLGETPROGRAMIVPROC)                                                   \
  X(getShaderInfoLog, "glGetShaderInfoLog", PFNGLGETSHADERINFOLOGPROC)                                       \
  X(getShaderiv, "glGetShaderiv", PFNGLGETSHADERIVPROC)                                                      \
  X(getString, "glGetString", PFNGLGETSTRINGPROC)                                                            \
  X(getUniformLocation, "glGetUniformLocation", PFNGLGETUNIFORMLOCATIONPROC)                                 \
  X(linkProgram, "glLinkProgram", PFNGLLINKPROGRAMPROC)                                                      \
  X(pixelStorei, "glPixelStorei", PFNGLPIXELSTOREIPROC)                                                      \
  X(readPixels, "glReadPixels", PFNGLREADPIXELSPROC)                                                         \
  X(renderbufferStorage, "glRenderbufferStorage", PFNGLRENDERBUFFERSTORAGEPROC)                              \
  X(shaderSource, "glShaderSource", PFNGLSHADERSOURCEPROC)                                                   \
  X(texBuffer, "glTexBuffer", PFNGLTEXBUFFERPROC)                                                            \
  X(uniform2f, "glUniform2f", PFNGLUNIFORM2FPROC)                                                            \
  X(useProgram, "glUseProgram", PFNGLUSEPROGRAMPROC)                                                         \
  X(vertexAttribDivisor, "glVertexAttribDivisor", PFNGLVERTEXATTRIBDIVISORPROC)                              \
  X(vertexAttribIPointer, "glVertexAttribIPointer", PFNGLVERTEXATTRIBIPOINTERPROC)                           \
  X(vertexAttribPointer, "glVertexAttribPointer", PFNGLVERTEXATTRIBPOINTERPROC)                              \
  X(viewport, "glViewport", PFNGLVIEWPORTPROC)

/// GL entry points of one context.
struct GlFunctions {
#define OFFSTAGE_GL_MEMBER(member, name, type) type member = nullptr;
  OFFSTAGE_GL_FUNCTIONS(OFFSTAGE_GL_MEMBER)
#undef OFFSTAGE_GL_MEMBER
};

/// Looks all of them up. Throws Error(Environment) naming one that the driver lacks.
GlFunctions loadGlFunctions(const GlContext& context);

/// Throws Error(Environment) when GL has recorded an error since the last call (Error(Transient) when it ran
/// out of memory); `doing` says in the message what was being done.
void checkGl(const GlFunctions& gl, const char* doing);

} // namespace offstage
