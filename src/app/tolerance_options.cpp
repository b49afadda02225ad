#include "src/app/tolerance_options.h"

#include "render/job/number_option.h"
#include "src/scene/tolerance_file.h"

#include <array>

namespace offstage {
namespace {

/// "10,20,30,40" as x, y, width, height.
IgnoredRegion parseRegion(const std::string& text) {
  std::array<int, 4> numbers{};
  const char* at = text.data();
  const char* end = at + text.size();
  bool good = true;
  for (std::size_t i = 0; i < numbers.size() && good; ++i) {
    const auto [next, error] = std::from_chars(at, end, numbers.at(i));
    const bool last = i + 1 == numbers.size();
    good = error == std::errc{} && (last ? next == end : next != end && *next == ',');
    at = last ? next : next + 1;
  }
  if (!good || numbers[2] < 0 || numbers[3] < 0)
    throw Error(ExitCode::BadInput, fmt::format("--ignore '{}' is not X,Y,WIDTH,HEIGHT in pixels", text));
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

template <class T>
void replace(std::optional<T>& value, const std::optional<T>& by) {
  if (by) value = by;
}

} // namespace

Tolerance ToleranceOptions::in(const std::filesystem::path& folder) const {
  Tolerance tolerance;
  const std::filesystem::path beside = folder / "tolerance.toml";
  std::error_code error;
  if (file)
    tolerance = loadTolerance(*file);
  else if (std::filesystem::exists(beside, error))
    tolerance = loadTolerance(beside);
  replace(tolerance.maxChannel, given.maxChannel);
  replace(tolerance.maxPixels, given.maxPixels);
  replace(tolerance.maxRatio, given.maxRatio);
  replace(tolerance.maxCluster, given.maxCluster);
  replace(tolerance.flipMax, given.flipMax);
  replace(tolerance.ssimMin, given.ssimMin);
  replace(tolerance.maxForgiven, given.maxForgiven);
  tolerance.ignoreAntialiasing = tolerance.ignoreAntialiasing || given.ignoreAntialiasing;
  tolerance.strictAlpha = tolerance.strictAlpha || given.strictAlpha;
  tolerance.ignore.insert(tolerance.ignore.end(), given.ignore.begin(), given.ignore.end());
  tolerance.masks.insert(tolerance.masks.end(), given.masks.begin(), given.masks.end());
  return tolerance;
}

void addToleranceOptions(CLI::App& app, ToleranceOptions& options) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  Tolerance& given = options.given;
  app.add_option("--tolerance", options.file,
                 "a TOML file of limits (default: tolerance.toml beside what is expected, if there is one)")
      ->type_name("FILE");
  addNumber(app, "--max-channel", given.maxChannel, "N",
            "a pixel differs when a channel is off by more, of 255 (default 0)", 0.0, 255.0);
  addNumber(app, "--max-differing", given.maxPixels, "N", "so many pixels may differ (max_pixels; default 0)",
            std::int64_t{0}, kMost);
  addNumber(app, "--max-ratio", given.maxRatio, "F", "such a share of the pixels may differ", 0.0, 1.0);
  addNumber(app, "--max-cluster", given.maxCluster, "N", "so many differing pixels may touch each other",
            std::int64_t{0}, kMost);
  addNumber(app, "--flip-max", given.flipMax, "F", "the FLIP error that no pixel may exceed", 0.0, 1.0);
  addNumber(app, "--ssim-min", given.ssimMin, "F", "the least mean structural similarity", -1.0, 1.0);
  app.add_flag("--ignore-antialiasing", given.ignoreAntialiasing,
               "forgive pixels that look like a moved antialiased edge; they are counted apart");
  addNumber(app, "--max-forgiven", given.maxForgiven, "N", "so many pixels may be forgiven", std::int64_t{0},
            kMost);
  app.add_option_function<std::vector<std::string>>(
         "--ignore",
         [&given](const std::vector<std::string>& regions) {
           for (const std::string& region : regions) given.ignore.push_back(parseRegion(region));
         },
         "a region that is not compared; may be repeated")
      ->allow_extra_args(false)
      ->type_name("X,Y,W,H");
  app.add_option("--mask", given.masks, "a picture, dark where pixels are not compared; may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app.add_flag("--strict-alpha", given.strictAlpha, "compare colours under alpha 0 too");
}

} // namespace offstage
