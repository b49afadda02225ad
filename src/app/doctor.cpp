#include "render/draw/font_library.h"
#include "render/draw/formula.h"
#include "render/output/codecs.h"
#include "render/raster/canvas.h"
#include "src/app/commands.h"
#include "src/sim/error.h"

#include <filesystem>
#include <string_view>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace offstage {
namespace {

void line(std::string_view what, std::string_view finding) {
  fmt::print("{:<12} {}\n", what, finding);
}

/// Each prints what it finds, and returns whether all that it looked for is there.
bool reportGl() {
  try {
    const Canvas::Info info = Canvas(16, 16).info();
    line("GL", fmt::format("ok: {}, {}, {}", info.backend, info.renderer, info.version));
    line("pixels", info.backend == "egl-device"
                       ? "a graphics processor's: may differ by 1/255 from those of osmesa and egl"
                       : "the same on every machine");
    line("picture", fmt::format("at most {0}x{0} px", info.maxSize));
    return true;
  } catch (const Error& error) {
    line("GL", fmt::format("missing: {}", error.what()));
    return false;
  }
}

bool reportCodecs() {
  line("FFmpeg", libavVersions());
  bool all = true;
  for (const CodecStatus& codec : codecStatus()) {
    all = all && codec.present;
    line("codec", codec.present ? fmt::format("ok: {} ({})", codec.encoder, codec.purpose)
                                : fmt::format("missing: {} ({}); install {}", codec.encoder, codec.purpose,
                                              codec.package));
  }
  return all;
}

bool reportFonts() {
  bool all = true;
  FontLibrary fonts;
  for (const Typeface typeface : {Typeface::Sans, Typeface::SansBold, Typeface::Mono, Typeface::MonoBold}) {
    FontChoice choice;
    choice.typeface = typeface;
    try {
      static_cast<void>(fonts.get(choice));
      line("font", fmt::format("ok: {}", fontFile(choice).string()));
    } catch (const Error& error) {
      all = false;
      line("font", fmt::format("missing: {}", error.what()));
    }
  }
  return all;
}

/// Only formulas need it, so a machine without it lacks nothing.
void reportTex() {
  const std::string programs = texPrograms();
  line("TeX",
       programs.empty() ? fmt::format("none; for formulas install {}", kTexPackages) : "ok: " + programs);
}

std::string limitText(int resource, rlim_t unit, std::string_view unitName) {
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return "unknown";
  if (limit.rlim_cur == RLIM_INFINITY) return "unlimited";
  return fmt::format("{}{}", limit.rlim_cur / unit, unitName);
}

void reportLimits() {
  const auto pages = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES));
  const auto pageSize = static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  line("processors", fmt::format("{}", std::thread::hardware_concurrency()));
  line("memory", fmt::format("{} MiB, address space {}", pages * pageSize >> 20U,
                             limitText(RLIMIT_AS, 1U << 20U, " MiB")));
  line("open files", limitText(RLIMIT_NOFILE, 1, ""));
  line("file size", limitText(RLIMIT_FSIZE, 1U << 20U, " MiB"));
  std::error_code failed;
  const std::filesystem::space_info space = std::filesystem::space(".", failed);
  line("disk", failed ? failed.message() : fmt::format("{} MiB free here", space.available >> 20U));
}

} // namespace

void addDoctor(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("doctor", "Say what this machine has and what it lacks");
  verb.callback([&action] {
    action = [] {
      line("offstage", OFFSTAGE_VERSION);
      const bool gl = reportGl();
      const bool codecs = reportCodecs();
      const bool fonts = reportFonts();
      reportTex();
      reportLimits();
      return static_cast<int>(gl && codecs && fonts ? ExitCode::Done : ExitCode::Environment);
    };
  });
}

} // namespace offstage
