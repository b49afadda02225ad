#pragma once

#include "render/compare/comparison.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace offstage {

/// A number or word of a case, under the name that JSON gives it.
struct ReportNumber {
  std::string key;   ///< "differing_pixels": JSON's key
  std::string label; ///< "differing pixels": what people read; empty: for programs, people are not shown it
  /// Doubles that are not finite become null in JSON; a list of integers is an array.
  std::variant<std::int64_t, double, std::string, bool, std::vector<std::int64_t>> value;
  std::string unit{}; ///< "px", "dB", …; empty without one
};

/// Values over the frames of a sequence, or over time: what the report draws.
struct ReportCurve {
  std::string key;            ///< "differing_pixels"
  std::string name;           ///< "differing pixels"
  std::string unit;           ///< "px"
  std::vector<double> times;  ///< s, or the frame's number where frames have no times; as many as values
  std::vector<double> values; ///< NaN: no value there
};

/// A picture of the report: a whole PNG as PngEncoder writes it, since the report's script reads its pixels.
/// Null: there is none.
using ReportPicture = std::shared_ptr<const std::vector<std::uint8_t>>;
ReportPicture reportPicture(const Frame& frame);

/// Pictures to look at together.
struct ReportPictures {
  std::string label;        ///< "frame 120, 2.000 s"; empty when a case has only one set
  ReportPicture expected;   ///< null: a golden that is missing
  ReportPicture actual;     ///< null: a golden that is obsolete
  ReportPicture difference; ///< makeDifferencePicture's
};

/// One thing that was compared: a picture, a frame, a golden, a trace.
struct ReportCase {
  std::string name; ///< unique in the report
  bool passed = true;
  std::string verdict;            ///< a few words: "same", "differs", "physics changed", "golden missing"
  std::vector<std::string> lines; ///< what to read: each failed limit with its numbers, notices
  std::string tolerance;          ///< its own, in words; empty: the report's
  double severity = 0.0;          ///< orders the list, worst first; 0: same
  double seconds = 0.0;           ///< what the comparison took
  std::vector<ReportNumber> numbers;
  std::vector<PixelPair> worst; ///< the worst pixels, worst first
  std::vector<ReportCurve> curves;
  std::vector<ReportPictures> pictures;
  std::string acceptCommand; ///< what takes the actual one over; empty: nothing to accept
};

/// What one run found.
struct Report {
  std::string title; ///< "offstage diff A B"
  std::string suite; ///< JUnit's name of the suite: "offstage.diff", "offstage.golden"
  bool passed = true;
  std::string verdict;               ///< of the whole: "same", "differs", "frame count differs", …
  std::string tolerance;             ///< the tolerance in force, in words; cases may have their own
  std::vector<std::string> lines;    ///< about the whole: the first differing frame, counts
  std::vector<ReportNumber> numbers; ///< of the whole; empty for a single pair
  std::vector<ReportCurve> curves;   ///< of a sequence
  std::vector<ReportCase> cases;     ///< in the order of their names or frames
};

/// The numbers of a comparison, in the order in which people read them.
std::vector<ReportNumber> reportNumbers(const Comparison& comparison);
/// A case of a compared picture; its pictures and accept command are the caller's.
ReportCase reportCase(const std::string& name, const Comparison& comparison);

/// As people read it on a terminal.
void writeText(std::ostream& out, const Report& report);
/// One JSON object (RFC 8259): title, passed, verdict, tolerance, the numbers under their keys, and cases.
void writeJson(std::ostream& out, const Report& report);
/// JUnit's XML, as Jenkins and GitLab read it: a testcase a case, a failure with its lines. Written whole or
/// not at all; throws as AtomicFile.
void writeJunit(const std::filesystem::path& file, const Report& report);
/// The same for a run that came to no verdict: one testcase, `title`, with an error that says why. So that no
/// earlier run's file stays and is taken for this one's. A file that is no such report is left alone.
void writeJunitError(const std::filesystem::path& file, const std::string& suite, const std::string& title,
                     const std::string& message);
/// A folder that opens from disk with no network: index.html holds data and pictures, beside it one style
/// sheet and one script. An earlier report there is replaced; a folder that holds anything else is refused
/// with Error(BadInput).
void writeHtml(const std::filesystem::path& folder, const Report& report);
/// Throws the Error that writeHtml would, before a long comparison.
void requireReportFolder(const std::filesystem::path& folder);

} // namespace offstage
