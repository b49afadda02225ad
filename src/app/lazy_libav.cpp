// Loads FFmpeg's libraries when the first of their functions is called; see lazy_libav.cmake.

#include "render/output/libav.h"
#include "render/raster/dynamic_library.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

extern "C" {
#include <libavutil/avutil.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>

extern const char* const offstageLibavNames[]; ///< ends with a null pointer
extern void* offstageLibavSlots[];             ///< by the same index
void offstageLoadLibav();
}

namespace {

using offstage::DynamicLibrary;

/// A library and the Debian package that has it.
struct Library {
  const char* file;
  const char* package;
};

constexpr std::array<Library, 5> kLibraries{{
    {"libavutil.so." AV_STRINGIFY(LIBAVUTIL_VERSION_MAJOR),
     "libavutil" AV_STRINGIFY(LIBAVUTIL_VERSION_MAJOR)},
    {"libavcodec.so." AV_STRINGIFY(LIBAVCODEC_VERSION_MAJOR),
     "libavcodec" AV_STRINGIFY(LIBAVCODEC_VERSION_MAJOR)},
    {"libavformat.so." AV_STRINGIFY(LIBAVFORMAT_VERSION_MAJOR),
     "libavformat" AV_STRINGIFY(LIBAVFORMAT_VERSION_MAJOR)},
    {"libswscale.so." AV_STRINGIFY(LIBSWSCALE_VERSION_MAJOR),
     "libswscale" AV_STRINGIFY(LIBSWSCALE_VERSION_MAJOR)},
    {"libswresample.so." AV_STRINGIFY(LIBSWRESAMPLE_VERSION_MAJOR),
     "libswresample" AV_STRINGIFY(LIBSWRESAMPLE_VERSION_MAJOR)},
}};

std::vector<DynamicLibrary> openAll() {
  std::vector<DynamicLibrary> libraries;
  for (const Library& library : kLibraries) {
    std::string reason;
    const auto opened = DynamicLibrary::open(library.file, reason);
    if (!opened && DynamicLibrary::lackedMemory(reason))
      throw offstage::Error(
          offstage::ExitCode::Transient,
          fmt::format("there is no memory to load {} ({}): raise the limit (ulimit -v), or end something",
                      library.file, reason));
    if (!opened)
      throw offstage::Error(offstage::ExitCode::Environment,
                            fmt::format("{} cannot be loaded ({}): install the Debian package {}",
                                        library.file, reason, library.package));
    libraries.push_back(*opened);
  }
  return libraries;
}

/// Fills every slot; true.
bool fillSlots() {
  const std::vector<DynamicLibrary> all = openAll();
  std::vector<void*> functions; // none is called before all are found
  for (std::size_t i = 0; offstageLibavNames[i] != nullptr; ++i) {
    void* function = nullptr;
    for (const DynamicLibrary& library : all) {
      function = reinterpret_cast<void*>(library.function<void (*)()>(offstageLibavNames[i]));
      if (function != nullptr) break;
    }
    if (function == nullptr)
      throw offstage::Error(
          offstage::ExitCode::Environment,
          fmt::format("FFmpeg's libraries lack {}: they are not those of this build", offstageLibavNames[i]));
    functions.push_back(function);
  }
  std::ranges::copy(functions, offstageLibavSlots);
  return true;
}

} // namespace

/// Fills the slots once, whichever thread comes first. Throws Error(Environment) when a library or a function
/// is missing.
void offstageLoadLibav() {
  static const bool kFilled = fillSlots();
  static_cast<void>(kFilled);
}
