#include "render/raster/canvas.h"
#include "render/raster/context.h"
#include "render/raster/gl_device.h"
#include "src/sim/error.h"
#include "tests/support/canvas_pictures.h"
#include "tests/support/child_process.h"

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using namespace offstage::test;
using Environment = ChildEnvironment;

// The tests named ContextChild.* are whole tests; the others also run them in processes with other settings,
// and read what they print.

TEST(ContextChild, PrintsBackendAndPixelHash) {
  const Picture picture = everythingPicture();
  Canvas canvas(picture.width, picture.height);
  Frame frame;
  canvas.draw(picture, frame);
  const Canvas::Info info = canvas.info();
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_NE(frame.hash(), drawOnce(blankPicture(picture.width, picture.height)).hash());
  std::cout << "renderer=" << info.renderer << '\n'
            << "backend=" << info.backend << '\n'
            << "hash=" << frame.hash() << '\n';
}

TEST(ContextChild, PrintsTheContextOrWhyThereIsNone) {
  try {
    const auto context = makeGlContext();
    EXPECT_NE(context->proc("glClear"), nullptr);
    std::cout << "backend=" << context->backend() << '\n';
  } catch (const Error& error) {
    EXPECT_NE(error.code(), ExitCode::Done);
    std::cout << "code=" << static_cast<int>(error.code()) << '\n' << "what=" << error.what() << '\n';
  }
  const char* threads = std::getenv("LP_NUM_THREADS");
  std::cout << "threads=" << (threads != nullptr ? threads : "unset") << '\n';
}

/// The value that a child printed as "key=value", or an empty string.
std::string printed(const ChildResult& child, const std::string& key) {
  const std::size_t at = child.output.find(key + "=");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + key.size() + 1;
  return child.output.substr(begin, child.output.find('\n', begin) - begin);
}

ChildResult drawInChild(const Environment& environment) {
  return runTestInChild("ContextChild.PrintsBackendAndPixelHash", environment);
}

std::string describe(const Environment& environment) {
  std::string text;
  for (const auto& [name, value] : environment) text += name + "=" + value.value_or("(unset)") + " ";
  return text;
}

TEST(Context, BothBackendsGiveTheSamePixels) {
  const ChildResult osMesa = drawInChild({{"OFFSTAGE_GL", "osmesa"}});
  const ChildResult egl = drawInChild({{"OFFSTAGE_GL", "egl"}});
  ASSERT_EQ(osMesa.exitStatus, 0) << osMesa.output;
  ASSERT_EQ(egl.exitStatus, 0) << egl.output;
  EXPECT_EQ(printed(osMesa, "backend"), "osmesa");
  EXPECT_EQ(printed(egl, "backend"), "egl");
  ASSERT_FALSE(printed(osMesa, "hash").empty()) << osMesa.output;
  EXPECT_EQ(printed(osMesa, "hash"), printed(egl, "hash"));
}

TEST(Context, PixelsDoNotDependOnProcessorVectorWidthOrThreads) {
  // Recorded with Mesa 22.3.6; the same from g++ and clang++ at any optimisation level.
  const std::string expected = "12659706187889724587";
  std::vector<Environment> settings;
  for (const char* width : {"128", "256", "512"}) {
    for (const char* caps : {"sse2", "sse4.1", "avx", "avx2", ""}) {
      Environment setting{{"LP_NATIVE_VECTOR_WIDTH", width}, {"MESA_SHADER_CACHE_DISABLE", "true"}};
      if (*caps != '\0') setting.emplace_back("GALLIUM_OVERRIDE_CPU_CAPS", caps);
      settings.push_back(setting);
    }
  }
  for (const char* threads : {"0", "1", "4"}) settings.push_back({{"LP_NUM_THREADS", threads}});
  for (const Environment& common : settings) {
    for (const char* backend : {"osmesa", "egl"}) {
      Environment setting = common;
      setting.emplace_back("OFFSTAGE_GL", backend);
      const ChildResult child = drawInChild(setting);
      EXPECT_EQ(printed(child, "hash"), expected)
          << describe(setting) << "on " << printed(child, "renderer") << ", exit status " << child.exitStatus;
    }
  }
}

TEST(Context, RefusesAnUnknownBackend) {
  const ChildResult child =
      runTestInChild("ContextChild.PrintsTheContextOrWhyThereIsNone", {{"OFFSTAGE_GL", "vulkan"}});
  EXPECT_EQ(printed(child, "code"), "2") << child.output;
  EXPECT_EQ(printed(child, "what"), "OFFSTAGE_GL is 'vulkan'; it may be osmesa, egl, egl-device or auto");
}

TEST(Context, NamesThePackagesWhenThereIsNoGl) {
  // No driver can be loaded from an empty folder, so EGL has no context to give.
  const ChildResult child = runTestInChild("ContextChild.PrintsTheContextOrWhyThereIsNone",
                                           {{"OFFSTAGE_GL", "egl"},
                                            {"LIBGL_DRIVERS_PATH", "/nonexistent"},
                                            {"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"}});
  EXPECT_EQ(printed(child, "code"), "3") << child.output;
  for (const char* package : {"libosmesa6", "libegl1", "libegl-mesa0", "libgl1-mesa-dri"}) {
    EXPECT_NE(child.output.find(package), std::string::npos) << package << " is not in: " << child.output;
  }
}

TEST(Context, LlvmpipeHasNoThreadsOfItsOwnUnlessTheUserHasChosen) {
  const std::string filter = "ContextChild.PrintsTheContextOrWhyThereIsNone";
  EXPECT_EQ(printed(runTestInChild(filter, {{"LP_NUM_THREADS", std::nullopt}}), "threads"), "0");
  EXPECT_EQ(printed(runTestInChild(filter, {{"LP_NUM_THREADS", "3"}}), "threads"), "3");
}

TEST(Context, AutoPrefersOsMesa) {
  const std::string filter = "ContextChild.PrintsTheContextOrWhyThereIsNone";
  EXPECT_EQ(printed(runTestInChild(filter, {{"OFFSTAGE_GL", std::nullopt}}), "backend"), "osmesa");
  EXPECT_EQ(printed(runTestInChild(filter, {{"OFFSTAGE_GL", "auto"}}), "backend"), "osmesa");
  EXPECT_EQ(printed(runTestInChild(filter, {{"OFFSTAGE_GL", ""}}), "backend"), "osmesa");
}

TEST(GlDevice, RefusesASecondThreadWhileCanvasesLive) {
  const Canvas canvas(4, 4);
  bool refused = false;
  std::thread other([&] {
    try {
      const Canvas second(4, 4);
    } catch (const std::logic_error&) {
      refused = true;
    }
  });
  other.join();
  EXPECT_TRUE(refused);
}

} // namespace
} // namespace offstage
