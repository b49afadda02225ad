#include "render/compare/compare_files.h"
#include "render/compare/compare_images.h"
#include "render/compare/frame_rows.h"
#include "render/compare/parallel.h"
#include "render/compare/shell_word.h"

#include <chrono>

#include <fmt/format.h>

namespace offstage {

CompareResult comparePictures(const std::filesystem::path& expected, const std::filesystem::path& actual,
                              const CompareOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::string> notices;
  const auto [expectedRows, actualRows] = openPictures(expected, actual, options.maxPixels, notices);
  Comparer comparer(options.tolerance, options.metrics, defaultThreads());
  Comparison comparison = comparer.compare(*expectedRows, *actualRows);
  comparison.notices = std::move(notices);

  CompareResult result;
  ReportCase one = reportCase(actual.filename().string(), comparison);
  one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!one.passed)
    one.acceptCommand = fmt::format("cp {} {}", shellWord(actual.string()), shellWord(expected.string()));
  if (options.pictures || options.strip) {
    const Frame expectedFrame = toFrame(*expectedRows);
    const Frame actualFrame = toFrame(*actualRows);
    const Frame difference = comparer.difference(*expectedRows, *actualRows);
    if (options.pictures)
      one.pictures.push_back(
          {"", reportPicture(expectedFrame), reportPicture(actualFrame), reportPicture(difference)});
    if (options.strip) result.strip = makeStrip(expectedFrame, difference, actualFrame);
  }
  Report& report = result.report;
  report.title = fmt::format("offstage diff {} {}", expected.string(), actual.string());
  report.suite = "offstage.diff";
  report.passed = one.passed;
  report.verdict = one.verdict;
  report.tolerance = toleranceText(options.tolerance);
  report.cases.push_back(std::move(one));
  return result;
}

} // namespace offstage
