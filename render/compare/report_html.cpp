#include "render/compare/report.h"
#include "render/compare/report_assets.h"
#include "render/compare/report_json.h"
#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/json_text.h"
#include "src/scene/utf8.h"
#include "src/sim/error.h"

#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

namespace offstage {
namespace {

/// What tells an earlier report from a page of somebody else.
constexpr std::string_view kGenerator = "<meta name=\"generator\" content=\"Offstage report\">";

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = (word << 8U) | (k < there ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= there ? kDigits[(word >> (18U - 6U * static_cast<unsigned>(k))) & 63U] : '=';
  }
  return text;
}

std::string pictureJson(const ReportPicture& picture) {
  return picture ? '"' + base64(*picture) + '"' : "null";
}

std::string numbersJson(const std::vector<ReportNumber>& numbers) {
  std::string text = "[";
  for (const ReportNumber& number : numbers)
    text +=
        fmt::format(R"({}{{"key": {}, "label": {}, "unit": {}, "value": {}}})", text.size() > 1 ? ", " : "",
                    jsonText(number.key), jsonText(number.label), jsonText(number.unit), jsonValue(number));
  return text + "]";
}

std::string caseJson(const ReportCase& one) {
  std::string pictures;
  for (const ReportPictures& set : one.pictures)
    pictures += fmt::format(R"({}{{"label": {}, "expected": {}, "actual": {}, "difference": {}}})",
                            pictures.empty() ? "" : ", ", jsonText(set.label), pictureJson(set.expected),
                            pictureJson(set.actual), pictureJson(set.difference));
  return fmt::format(
      R"({{"name": {}, "passed": {}, "verdict": {}, "severity": {}, "tolerance": {}, "lines": {}, )"
      R"("numbers": {}, "worst": {}, "curves": {}, "accept": {}, "pictures": [{}]}})",
      jsonText(one.name), one.passed, jsonText(one.verdict), jsonNumber(one.severity),
      jsonText(one.tolerance), jsonLines(one.lines), numbersJson(one.numbers), jsonWorst(one.worst),
      jsonCurves(one.curves), jsonText(one.acceptCommand), pictures);
}

std::string dataJson(const Report& report) {
  std::string json = fmt::format(
      R"({{"title": {}, "passed": {}, "verdict": {}, "tolerance": {}, "lines": {}, "numbers": {}, "curves": {}, "cases": [)",
      jsonText(report.title), report.passed, jsonText(report.verdict), jsonText(report.tolerance),
      jsonLines(report.lines), numbersJson(report.numbers), jsonCurves(report.curves));
  const char* separator = "\n";
  for (const ReportCase& one : report.cases) {
    json += separator + caseJson(one);
    separator = ",\n";
  }
  json += "]}";
  // Within a script element "<" could end it.
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

std::string htmlText(std::string_view text) {
  std::string html;
  for (const char c : repairedUtf8(text)) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else
      html += c;
  }
  return html;
}

void replaceOnce(std::string& page, std::string_view mark, const std::string& by) {
  page.replace(page.find(mark), mark.size(), by);
}

void write(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

bool isReport(const std::filesystem::path& page) {
  std::ifstream in(page, std::ios::binary);
  std::string head(1024, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find(kGenerator) != std::string::npos;
}

} // namespace

void requireReportFolder(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(folder, error);
  if (!std::filesystem::exists(status)) {
    // Its parent has to be there: a typo should not make a tree.
    const std::filesystem::path parent = folderOf(folder.has_filename() ? folder : folder.parent_path());
    if (std::filesystem::is_directory(parent, error)) return;
    throw Error(ExitCode::BadInput,
                fmt::format("cannot write {}: there is no folder {}", quoted(folder), quoted(parent)));
  }
  if (!std::filesystem::is_directory(status))
    throw Error(ExitCode::BadInput, fmt::format("cannot write {}: it is not a folder", quoted(folder)));
  if (std::filesystem::is_empty(folder, error) || isReport(folder / "index.html")) return;
  throw Error(ExitCode::BadInput,
              fmt::format("{} holds other files; give a new folder for the report", quoted(folder)));
}

void writeHtml(const std::filesystem::path& folder, const Report& report) {
  requireReportFolder(folder);
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (error) throw fileError(error.value(), folder);
  std::string page(kReportPage);
  replaceOnce(page, "@TITLE@", htmlText(report.title));
  replaceOnce(page, "@DATA@", dataJson(report));
  write(folder / "report.css", kReportStyle);
  write(folder / "report.js", kReportScript);
  write(folder / "index.html", page);
}

} // namespace offstage
