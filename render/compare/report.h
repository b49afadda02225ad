#pragma once

#include "render/compare/comparison.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace offstage {

/// A number or word of a case, under the name that JSON gives it.
struct ReportNumber {
  std::string key;   ///< "differing_pixels"; JSON key
  std::string label; ///< "Differing pixels"; what people read
  std::variant<std::int64_t, double, std::string, bool>
      value;          ///< NaN and infinite doubles become null in JSON
  std::string unit{}; ///< "px", "dB", …; empty without one
};

/// Values over the frames of a sequence: what the report draws.
struct ReportCurve {
  std::string name; ///< "differing pixels"
  std::string unit;
  std::vector<double> times; ///< s, as many as values
  std::vector<double> values;
};

/// Two (or one) pictures to look at. Files are PNGs, as given; the HTML report takes their bytes in.
struct ReportPictures {
  std::string label;                ///< "frame 120, 2.000 s"; empty when a case has only one
  std::filesystem::path expected;   ///< empty: there is none (a missing golden)
  std::filesystem::path actual;     ///< empty: there is none (an obsolete golden)
  std::filesystem::path difference; ///< empty: the report shows the computed one only
};

/// One thing that was compared: a picture, a frame sequence, a golden, a trace.
struct ReportCase {
  std::string name; ///< unique in the report
  bool passed = true;
  std::string verdict;            ///< a few words: "same", "differs", "physics changed", "golden missing"
  std::vector<std::string> lines; ///< what to read: each failed limit with its numbers, notices
  double severity = 0.0;          ///< orders the list, worst first; 0: same
  double seconds = 0.0;           ///< what the comparison took
  std::vector<ReportNumber> numbers;
  std::vector<ReportCurve> curves;
  std::vector<ReportPictures> pictures;
  std::string acceptCommand; ///< what takes the actual one over; empty: nothing to accept
};

struct Report {
  std::string title;     ///< "offstage diff A B"
  std::string suite;     ///< JUnit's suite: "offstage.diff", "offstage.golden"
  std::string tolerance; ///< the tolerance in force, in words
  std::vector<ReportCase> cases;

  [[nodiscard]] bool passed() const;
};

/// The numbers of a comparison, in the order in which people read them.
std::vector<ReportNumber> reportNumbers(const Comparison& comparison);
/// A case of a compared picture; pictures and accept command are the caller's.
ReportCase reportCase(const std::string& name, const Comparison& comparison);

/// As people read it on a terminal.
void writeText(std::ostream& out, const Report& report);
/// One JSON object (RFC 8259): title, passed, tolerance, cases with their numbers as keys.
void writeJson(std::ostream& out, const Report& report);
/// JUnit's XML, as Jenkins and GitLab read it: a testcase a case, a failure with the lines. Atomic.
void writeJunit(const std::filesystem::path& file, const Report& report);
/// A folder with index.html that opens from disk: pictures and data are inside it. An earlier report there
/// is replaced; a folder that holds anything else is refused with Error(BadInput).
void writeHtml(const std::filesystem::path& folder, const Report& report);

} // namespace offstage
