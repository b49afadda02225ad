#include "src/scene/tolerance.h"

#include <fmt/format.h>

namespace offstage {
namespace {

/// A share in %, in the digits that were given for it: times 100, 0.07 is 7.000000000000001.
std::string percentText(double share) {
  return fmt::format("{:.15g}", share * 100);
}

} // namespace

std::string toleranceText(const Tolerance& tolerance) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (tolerance.limitsPixels()) {
    const std::string pixels =
        tolerance.maxChannel.value_or(0.0) > 0.0
            ? fmt::format("off by more than {} of 255 in a channel", *tolerance.maxChannel)
            : "unequal";
    if (!tolerance.maxPixels && !tolerance.maxRatio && !tolerance.maxCluster) add("no pixel " + pixels);
    if (tolerance.maxPixels) add(fmt::format("at most {} px {}", *tolerance.maxPixels, pixels));
    if (tolerance.maxRatio)
      add(fmt::format("at most {} % of the pixels {}", percentText(*tolerance.maxRatio), pixels));
    if (tolerance.maxCluster) add(fmt::format("at most {} px {} together", *tolerance.maxCluster, pixels));
  }
  if (tolerance.flipMax) add(fmt::format("FLIP at most {} anywhere", *tolerance.flipMax));
  if (tolerance.ssimMin) add(fmt::format("SSIM at least {}", *tolerance.ssimMin));
  if (tolerance.ignoreAntialiasing)
    add(tolerance.maxForgiven ? fmt::format("at most {} px forgiven as antialiasing", *tolerance.maxForgiven)
                              : "antialiasing forgiven");
  if (!tolerance.ignore.empty())
    add(fmt::format("{} region{} ignored", tolerance.ignore.size(), tolerance.ignore.size() == 1 ? "" : "s"));
  for (const std::filesystem::path& mask : tolerance.masks) add(fmt::format("mask {}", mask.string()));
  if (tolerance.strictAlpha) add("colours under alpha 0 compared");
  if (!tolerance.file.empty()) text += fmt::format(" ({})", tolerance.file.string());
  return text;
}

} // namespace offstage
