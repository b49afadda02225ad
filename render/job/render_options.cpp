#include "render/job/render_options.h"

#include "render/output/file_error.h"

#include <string_view>

#include <fmt/format.h>

namespace offstage {

Viewport RenderOptions::viewport(double paneWidth, double paneHeight, double sceneScale) const {
  if (size) return Viewport::fitted(paneWidth, paneHeight, (*size)[0], (*size)[1]);
  return Viewport::scaled(paneWidth, paneHeight, sceneScale);
}

std::vector<std::string> RenderOptions::drawingArguments() const {
  std::vector<std::string> arguments;
  const auto add = [&arguments](std::string_view name, const auto& value) {
    if (value)
      arguments.push_back(fmt::format("--{}={}", name, *value)); // doubles in their shortest exact form
  };
  if (size) arguments.push_back(fmt::format("--size={}x{}", (*size)[0], (*size)[1]));
  add("fps", fps);
  add("duration", duration);
  add("from", from);
  add("to", to);
  if (input) arguments.push_back(fmt::format("--input={}", placeOf(*input).native()));
  if (dtLog) arguments.push_back(fmt::format("--dt={}", placeOf(*dtLog).native()));
  add("seed", seed);
  add("scale", scale);
  if (quality) arguments.push_back(fmt::format("--quality={}", qualityName(*quality)));
  return arguments;
}

} // namespace offstage
