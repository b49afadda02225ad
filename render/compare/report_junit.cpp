#include "render/compare/report.h"
#include "render/output/atomic_file.h"
#include "src/scene/utf8.h"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::string_view kDeclaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

/// Text for XML 1.0. Control characters that XML cannot hold and bytes that are not UTF-8 become U+FFFD.
std::string xmlText(std::string_view text) {
  std::string xml;
  for (const char c : repairedUtf8(text)) {
    switch (c) {
    case '&':
      xml += "&amp;";
      break;
    case '<':
      xml += "&lt;";
      break;
    case '>':
      xml += "&gt;";
      break;
    case '"':
      xml += "&quot;";
      break;
    case '\n':
      xml += "&#10;";
      break;
    default:
      if (static_cast<unsigned char>(c) < 0x20 && c != '\t')
        xml += "\xEF\xBF\xBD";
      else
        xml += c;
    }
  }
  return xml;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Whether nothing would be lost: no file, an empty one, or an earlier writeJunit's or writeJunitError's.
bool mayBeReplaced(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return true;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  const std::string start = std::string(kDeclaration) + "<testsuites ";
  std::string head(start.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return in.gcount() == 0 ? std::filesystem::file_size(file, error) == 0 : head == start;
}

} // namespace

void writeJunitError(const std::filesystem::path& file, const std::string& suite, const std::string& title,
                     const std::string& message) {
  if (!mayBeReplaced(file)) return;
  AtomicFile out(file);
  out.write(kDeclaration);
  out.write(fmt::format("<testsuites tests=\"1\" failures=\"0\" errors=\"1\" time=\"0.000\">\n"
                        "  <testsuite name=\"{0}\" tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\" "
                        "time=\"0.000\">\n"
                        "    <testcase classname=\"{0}\" name=\"{1}\" time=\"0.000\">\n"
                        "      <error message=\"{2}\" type=\"no verdict\">{2}</error>\n"
                        "    </testcase>\n  </testsuite>\n</testsuites>\n",
                        xmlText(suite), xmlText(title), xmlText(message)));
  out.commit();
}

void writeJunit(const std::filesystem::path& file, const Report& report) {
  // A sequence is a case of its own: frames may be missing, or only the whole may fail.
  std::vector<ReportCase> cases = report.cases;
  if (!report.numbers.empty() || cases.empty()) {
    ReportCase whole;
    whole.name = report.title;
    whole.passed = report.passed;
    whole.verdict = report.verdict;
    whole.lines = report.lines;
    cases.insert(cases.begin(), whole);
  }
  const auto failures = std::ranges::count_if(cases, [](const ReportCase& one) { return !one.passed; });
  double seconds = 0.0;
  for (const ReportCase& one : cases) seconds += one.seconds;

  AtomicFile out(file);
  out.write(kDeclaration);
  out.write(fmt::format("<testsuites tests=\"{0}\" failures=\"{1}\" errors=\"0\" time=\"{2:.3f}\">\n"
                        "  <testsuite name=\"{3}\" tests=\"{0}\" failures=\"{1}\" errors=\"0\" skipped=\"0\" "
                        "time=\"{2:.3f}\">\n",
                        cases.size(), failures, seconds, xmlText(report.suite)));
  for (const ReportCase& one : cases) {
    out.write(fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", xmlText(report.suite),
                          xmlText(one.name), one.seconds));
    if (one.passed) {
      out.write("/>\n");
      continue;
    }
    out.write(fmt::format(">\n      <failure message=\"{}\" type=\"{}\">{}</failure>\n    </testcase>\n",
                          xmlText(one.lines.empty() ? one.verdict : one.verdict + ": " + one.lines.front()),
                          xmlText(one.verdict),
                          xmlText(joined(one.lines) + "tolerance: " +
                                  (one.tolerance.empty() ? report.tolerance : one.tolerance))));
  }
  out.write("  </testsuite>\n</testsuites>\n");
  out.commit();
}

} // namespace offstage
