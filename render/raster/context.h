#pragma once

#include <memory>
#include <string>

namespace offstage {

/// A current OpenGL 3.3 context without a window. The libraries are loaded at run time, so the program starts
/// (and can say what is missing) on a machine without them. One context a process; used from the thread that
/// made it. Of the compatibility profile, though only core functions are called: in the core profile every
/// point is a sprite, which llvmpipe draws as a polygon of four edges; others it draws as rectangles (a frame
/// of 10,000 discs in 17 ms instead of 20, the same pixels).
class GlContext {
public:
  using Proc = void (*)();
  virtual ~GlContext() = default;
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  [[nodiscard]] virtual Proc proc(const char* name) const = 0; ///< a GL function, or null
  [[nodiscard]] virtual std::string backend() const = 0;       ///< "osmesa", "egl" or "egl-device"
};

/// Makes the context that the environment variable OFFSTAGE_GL asks for: "osmesa", "egl", "egl-device" (a
/// graphics processor, whose pixels may differ from the others' by 1/255), or "auto" (default: OSMesa, then
/// EGL surfaceless). Sets LP_NUM_THREADS=0 unless the user has set it: Offstage's parallelism is processes.
/// Throws Error(Environment) naming the Debian packages when there is none, Error(BadInput) on another value.
std::unique_ptr<GlContext> makeGlContext();

/// What draws the pixels: "llvmpipe" unless the user has chosen another driver of Mesa (GALLIUM_DRIVER) or a
/// graphics processor ("egl-device"). Pixels of different drivers may differ.
std::string glDriver();

/// Loads the library that makeGlContext() will most likely use, and makes nothing with it: processes that are
/// forked afterwards share its memory (of LLVM alone 8 MB that the loader has written to) and the time that
/// loading takes. Does nothing where it is missing, or another one is asked for. May be called from a thread
/// once prepareGl() has been called.
void preloadGl();

/// Sets the environment variables that Mesa reads, unless the user has. Whether preloadGl() will load
/// something. No other thread may read the environment meanwhile.
bool prepareGl();

} // namespace offstage
