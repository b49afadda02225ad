#include "render/compare/compare_files.h"
#include "render/compare/compare_images.h"
#include "render/compare/frame_rows.h"
#include "render/compare/frame_stream.h"
#include "render/compare/parallel.h"
#include "render/compare/shell_word.h"
#include "render/compare/worst_frames.h"
#include "render/output/file_error.h"
#include "src/sim/error.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Frames that are read ahead and compared at the same time.
constexpr std::size_t kBatch = 8;
/// Two times of a frame are the same within so many seconds: half of the coarsest container's unit.
constexpr double kSameTime = 0.0006;

/// A pair of frames of two sequences, and what came of it.
struct FramePair {
  std::int64_t number = 0;
  StreamFrame expected;
  StreamFrame actual;
  bool equal = false; ///< byte for byte: no pixel was looked at
  Comparison comparison;
  std::vector<std::string> notices;
  double seconds = 0.0;

  [[nodiscard]] bool absent() const { return expected.absent() || actual.absent(); }
  [[nodiscard]] std::optional<double> time() const { return expected.time ? expected.time : actual.time; }
  [[nodiscard]] bool shiftedInTime() const {
    return expected.video && actual.video && std::abs(*expected.time - *actual.time) > kSameTime;
  }
  [[nodiscard]] bool passed() const { return !absent() && !shiftedInTime() && comparison.same(); }
};

using Pictures = std::pair<std::shared_ptr<const PixelRows>, std::shared_ptr<const PixelRows>>;

/// What one thread compares with.
struct Worker {
  explicit Worker(const CompareOptions& options) : comparer(options.tolerance, options.metrics, 1) {}

  Comparer comparer;
  VideoConverter expectedConverter;
  VideoConverter actualConverter;

  Pictures open(FramePair& pair, std::int64_t maxPixels) {
    if (!pair.expected.file.empty() && !pair.actual.file.empty())
      return openPictures(pair.expected.file, pair.actual.file, maxPixels, pair.notices);
    return {openOne(pair.expected, expectedConverter, maxPixels, pair.notices),
            openOne(pair.actual, actualConverter, maxPixels, pair.notices)};
  }

  /// The one that is there, of a pair of which the other is absent.
  Pictures openThere(FramePair& pair, std::int64_t maxPixels) {
    Pictures pictures;
    const bool extra = pair.expected.absent();
    auto& there = extra ? pictures.second : pictures.first;
    there = openOne(extra ? pair.actual : pair.expected, expectedConverter, maxPixels, pair.notices);
    return pictures;
  }

  void compare(FramePair& pair, std::int64_t maxPixels) {
    const auto start = std::chrono::steady_clock::now();
    pair.equal =
        pair.expected.video && pair.actual.video && equalPictures(*pair.expected.video, *pair.actual.video);
    if (pair.equal) {
      noteEqual(pair);
    } else if (!pair.absent()) {
      const Pictures pictures = open(pair, maxPixels);
      pair.comparison = comparer.compare(*pictures.first, *pictures.second);
    } else {
      // A broken file never gets a verdict, not even "missing".
      openThere(pair, maxPixels);
    }
    pair.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

private:
  static std::shared_ptr<const PixelRows> openOne(const StreamFrame& frame, VideoConverter& converter,
                                                  std::int64_t maxPixels, std::vector<std::string>& notices) {
    if (frame.video) return std::make_shared<FrameRows>(converter.convert(*frame.video));
    return openPicture(frame.file, maxPixels, notices);
  }

  void noteEqual(FramePair& pair) {
    const AVFrame& frame = *pair.expected.video->frame;
    pair.comparison = comparer.equal(frame.width, frame.height);
  }
};

std::string frameName(const FramePair& pair) {
  const std::string& name = pair.expected.name.empty() ? pair.actual.name : pair.expected.name;
  if (name.empty()) return fmt::format("frame {}", pair.number);
  return name;
}

std::string placeOf(const FramePair& pair) {
  const auto time = pair.time();
  return time ? fmt::format("{} ({:.3f} s)", frameName(pair), *time) : frameName(pair);
}

/// Gathers what the report says, frame after frame.
class Summary {
public:
  explicit Summary(const CompareOptions& options)
      : options_(options), worst_(options.pictures ? kPictured : 0) {}

  void add(FramePair& pair, Worker& worker) {
    ++frames_;
    const Comparison& c = pair.comparison;
    if (pair.expected.absent())
      extra_.push_back(frameName(pair));
    else if (pair.actual.absent())
      missing_.push_back(frameName(pair));
    else
      addCompared(pair);
    ReportCase one = reportCase(frameName(pair), c);
    one.passed = pair.passed();
    one.seconds = pair.seconds;
    one.lines.insert(one.lines.end(), pair.notices.begin(), pair.notices.end());
    if (pair.absent()) {
      one.verdict = pair.expected.absent() ? "extra frame" : "missing frame";
      one.lines.push_back(pair.expected.absent() ? "only the actual sequence has it"
                                                 : "only the expected sequence has it");
      one.numbers.clear();
      one.severity = 2.0;
    } else if (pair.shiftedInTime()) {
      if (c.same()) one.verdict = "time differs";
      one.lines.push_back(
          fmt::format("shown at {:.6f} s, expected at {:.6f} s", *pair.actual.time, *pair.expected.time));
      one.severity = std::max(one.severity, 1.0);
    }
    if (const auto time = pair.time()) one.numbers.insert(one.numbers.begin(), {"time", "time", *time, "s"});
    one.numbers.insert(one.numbers.begin(), {"frame", "frame", pair.number});
    if (!one.passed && !pair.actual.file.empty() && !pair.expected.file.empty())
      one.acceptCommand = fmt::format("cp {} {}", shellWord(pair.actual.file.string()),
                                      shellWord(pair.expected.file.string()));
    addCurves(pair);
    if (!one.passed) addFailed(pair, one);
    keepPictures(pair, one, worker);
    const bool video = pair.expected.video && pair.actual.video;
    if (one.passed && video) return; // a video's frames are listed only where they differ
    if (cases_.size() < kListed || !one.passed) cases_.push_back(std::move(one));
  }

  CompareResult finish(const std::string& title) {
    CompareResult result;
    Report& report = result.report;
    report.title = title;
    report.suite = "offstage.diff";
    report.passed = failed_ == 0;
    report.verdict = verdict();
    report.tolerance = toleranceText(options_.tolerance);
    addLines(report);
    addNumbers(report);
    report.curves = {differing_, maxChannel_, psnr_};
    if (!flip_.values.empty()) report.curves.push_back(flip_);
    worst_.attachTo(cases_);
    report.cases = std::move(cases_);
    if (options_.strip) result.strip = std::move(strip_);
    return result;
  }

private:
  static constexpr std::size_t kPictured = 24;   ///< frames whose pictures the report shows
  static constexpr std::size_t kListed = 100000; ///< passing frames that are listed

  void addCompared(const FramePair& pair) {
    const Comparison& c = pair.comparison;
    if (c.kind == Comparison::Kind::SizeDiffers) ++sizes_;
    totalDiffering_ += c.differing;
    maxDifference_ = std::max(maxDifference_, c.maxChannel);
    leastPsnr_ = std::min(leastPsnr_, c.psnr);
    if (c.ssim) leastSsim_ = std::min(leastSsim_.value_or(1.0), *c.ssim);
    if (c.flip) largestFlip_ = std::max(largestFlip_.value_or(0.0), c.flip->max);
    forgiven_ += c.forgiven;
  }

  void addCurves(const FramePair& pair) {
    const Comparison& c = pair.comparison;
    const double time = pair.time().value_or(static_cast<double>(pair.number));
    const bool measured = !pair.absent() && c.kind != Comparison::Kind::SizeDiffers;
    const auto put = [&](ReportCurve& curve, double value) {
      curve.times.push_back(time);
      curve.values.push_back(measured ? value : std::numeric_limits<double>::quiet_NaN());
    };
    put(differing_, static_cast<double>(c.differing));
    put(maxChannel_, c.maxChannel);
    put(psnr_, c.psnr);
    if (c.flip) put(flip_, c.flip->max);
  }

  void addFailed(const FramePair& pair, const ReportCase& one) {
    ++failed_;
    if (pair.shiftedInTime()) ++shifted_;
    if (first_) return;
    first_ = pair.number;
    firstTime_ = pair.time();
    firstLine_ = fmt::format("first differing frame: {}: {}", placeOf(pair),
                             one.lines.empty() ? one.verdict : one.lines.front());
  }

  void keepPictures(FramePair& pair, const ReportCase& one, Worker& worker) {
    const bool worse = one.severity > worstSeverity_ || (frames_ == 1 && !strip_);
    const bool forStrip = options_.strip && !pair.absent() && worse;
    if (!forStrip && (one.passed || !worst_.wants(one.severity))) return;
    if (pair.absent()) return keepAbsent(pair, one, worker);
    const Pictures pictures = worker.open(pair, options_.maxPixels);
    const Frame expected = toFrame(*pictures.first);
    const Frame actual = toFrame(*pictures.second);
    const Frame difference = worker.comparer.difference(*pictures.first, *pictures.second);
    if (forStrip) {
      strip_ = makeStrip(expected, difference, actual);
      worstSeverity_ = one.severity;
    }
    if (!one.passed && worst_.wants(one.severity))
      worst_.add(one.name, one.severity,
                 {placeOf(pair), reportPicture(expected), reportPicture(actual), reportPicture(difference)});
  }

  void keepAbsent(FramePair& pair, const ReportCase& one, Worker& worker) {
    ReportPictures pictures{placeOf(pair), nullptr, nullptr, nullptr};
    const Pictures opened = worker.openThere(pair, options_.maxPixels);
    if (opened.first) pictures.expected = reportPicture(toFrame(*opened.first));
    if (opened.second) pictures.actual = reportPicture(toFrame(*opened.second));
    worst_.add(one.name, one.severity, std::move(pictures));
  }

  [[nodiscard]] std::string verdict() const {
    if (!missing_.empty() || !extra_.empty()) return "frame count differs";
    if (failed_ == 0) return "same";
    if (sizes_ == failed_) return "size differs";
    if (shifted_ == failed_ && totalDiffering_ == 0) return "time differs";
    return "differs";
  }

  void addLines(Report& report) const {
    const auto shared = frames_ - static_cast<std::int64_t>(missing_.size() + extra_.size());
    if (!missing_.empty() || !extra_.empty())
      report.lines.push_back(fmt::format("frame count differs: expected {}, actual {}",
                                         shared + static_cast<std::int64_t>(missing_.size()),
                                         shared + static_cast<std::int64_t>(extra_.size())));
    report.lines.push_back(fmt::format("{} of {} frames differ", failed_, frames_));
    if (first_) report.lines.push_back(firstLine_);
  }

  void addNumbers(Report& report) const {
    const auto add = [&](const char* key, const char* label, auto value, const char* unit = "") {
      report.numbers.push_back({key, label, value, unit});
    };
    add("frames", "frames", frames_);
    add("differing_frames", "differing frames", failed_);
    add("missing_frames", "missing frames", static_cast<std::int64_t>(missing_.size()));
    add("extra_frames", "extra frames", static_cast<std::int64_t>(extra_.size()));
    if (first_) add("first_differing_frame", "first differing frame", *first_);
    if (firstTime_) add("first_differing_time", "its time", *firstTime_, "s");
    add("differing_pixels", "differing pixels in all frames", totalDiffering_, "px");
    add("forgiven_pixels", "forgiven as antialiasing", forgiven_, "px");
    add("max_channel_difference", "max channel difference", maxDifference_, "of 255");
    add("psnr", "least PSNR", leastPsnr_, "dB");
    if (leastSsim_) add("ssim", "least SSIM", *leastSsim_);
    if (largestFlip_) add("flip_max", "FLIP max", *largestFlip_);
  }

  const CompareOptions& options_;
  std::int64_t frames_ = 0;
  std::int64_t failed_ = 0;
  std::int64_t sizes_ = 0;
  std::int64_t shifted_ = 0;
  std::vector<std::string> missing_;
  std::vector<std::string> extra_;
  std::optional<std::int64_t> first_;
  std::optional<double> firstTime_;
  std::string firstLine_;
  std::int64_t totalDiffering_ = 0;
  std::int64_t forgiven_ = 0;
  double maxDifference_ = 0.0;
  double leastPsnr_ = std::numeric_limits<double>::infinity();
  std::optional<double> leastSsim_;
  std::optional<double> largestFlip_;
  ReportCurve differing_{"differing_pixels", "differing pixels", "px", {}, {}};
  ReportCurve maxChannel_{"max_channel_difference", "max channel difference", "of 255", {}, {}};
  ReportCurve psnr_{"psnr", "PSNR", "dB", {}, {}};
  ReportCurve flip_{"flip_max", "FLIP max", "", {}, {}};
  std::vector<ReportCase> cases_;
  WorstFrames worst_;
  std::optional<Frame> strip_;
  double worstSeverity_ = 0.0;
};

} // namespace

CompareResult compareSequences(const std::filesystem::path& expected, const std::filesystem::path& actual,
                               const CompareOptions& options) {
  const int threads = defaultThreads();
  // Each sequence is read by a thread of its own; where there are more processors, the decoders use them.
  auto streams = openStreams(expected, actual, options.maxPixels, options.fps, std::max(1, threads / 2));
  std::vector<std::unique_ptr<Worker>> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) workers.push_back(std::make_unique<Worker>(options));
  Summary summary(options);
  std::int64_t number = 0;
  while (true) {
    std::array<std::vector<StreamFrame>, 2> frames;
    parallelFor(2, 1, threads, [&](int, int side, int) {
      FrameStream& stream = side == 0 ? *streams.first : *streams.second;
      auto& to = frames.at(static_cast<std::size_t>(side));
      while (to.size() < kBatch) {
        auto frame = stream.next();
        if (!frame) break;
        to.push_back(std::move(*frame));
      }
    });
    std::vector<FramePair> pairs(std::max(frames[0].size(), frames[1].size()));
    if (pairs.empty()) break;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      pairs[i].number = number++;
      if (i < frames[0].size()) pairs[i].expected = std::move(frames[0][i]);
      if (i < frames[1].size()) pairs[i].actual = std::move(frames[1][i]);
    }
    parallelFor(static_cast<int>(pairs.size()), 1, threads, [&](int worker, int index, int) {
      workers[static_cast<std::size_t>(worker)]->compare(pairs[static_cast<std::size_t>(index)],
                                                         options.maxPixels);
    });
    for (FramePair& pair : pairs) summary.add(pair, *workers.front());
  }
  if (number == 0)
    throw Error(ExitCode::BadInput,
                fmt::format("{} and {} hold no frames", quoted(expected), quoted(actual)));
  return summary.finish(fmt::format("offstage diff {} {}", expected.string(), actual.string()));
}

} // namespace offstage
