#include "render/draw/formula.h"

#include "render/draw/file_bytes.h"
#include "render/draw/image.h"
#include "render/draw/limited_process.h"
#include "src/scene/quote.h"
#include "src/sim/error.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr int kOversampling = 4;
constexpr double kPointsPerInch = 72.27;
constexpr double kFontPoints = 10.0; ///< of the document
/// Heights of a capital in em: DejaVu Sans 1493/2048, Computer Modern 0.683.
constexpr double kCapitals = 0.729 / 0.683;
constexpr std::size_t kLargestLog = 1UL << 20U;
constexpr const char* kDvipngLog = "dvipng.txt";

/// A folder of its own, removed with all that is in it.
class WorkFolder {
public:
  WorkFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "offstage-formula-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw Error(ExitCode::Transient, "no folder for typesetting a formula can be made in " +
                                           std::filesystem::temp_directory_path().string());
    path_ = name;
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// One box shipped out as it is: no page, no line breaks.
std::string documentOf(const std::string& formula) {
  return "\\documentclass[10pt]{article}\n"
         "\\usepackage{amsmath,amssymb}\n"
         "\\begin{document}\n"
         "\\setbox0\\hbox{$\\displaystyle\n" +
         formula +
         "\n$}\\shipout\\box0\n"
         "\\end{document}\n";
}

/// "p" is kpathsea's paranoid: no file beyond the working folder and TeX's own tree; the MKTEX… keep it from
/// making fonts, for which it would start a shell.
std::vector<std::string> environmentIn(const std::filesystem::path& folder) {
  const std::string here = folder.string();
  return {"PATH=/usr/bin:/bin",  "HOME=" + here, "TEXMFHOME=" + here,  "TEXMFVAR=" + here,
          "TEXMFCONFIG=" + here, "openin_any=p", "openout_any=p",      "shell_escape=f",
          "MKTEXTFM=0",          "MKTEXPK=0",    "MKTEXMF=0",          "MKTEXTEX=0",
          "MKTEXFMT=0",          "LC_ALL=C",     "SOURCE_DATE_EPOCH=0"};
}

std::string textOf(const std::filesystem::path& file) {
  try {
    const std::vector<std::uint8_t> bytes = readFileBytes(file, kLargestLog);
    return {bytes.begin(), bytes.end()};
  } catch (const std::runtime_error&) {
    return "";
  }
}

/// What TeX's log says is wrong: the line with "! " and, behind it, how far TeX had read.
std::string problemIn(const std::string& log) {
  const std::size_t begin = log.find("\n! ");
  if (begin == std::string::npos) return "TeX gives up without a reason";
  const auto lineAt = [&](std::size_t at) { return log.substr(at, log.find('\n', at) - at); };
  std::string problem = lineAt(begin + 3);
  const std::size_t read = log.find("\nl.", begin);
  if (read != std::string::npos) {
    const std::string line = lineAt(read + 1);
    const std::size_t blank = line.find(' ');
    if (blank != std::string::npos) problem += " after " + quotedText(line.substr(blank + 1));
  }
  return "TeX says: " + printable(problem);
}

[[noreturn]] void failOn(std::string_view program, std::string_view what) {
  throw Error(ExitCode::BadInput, fmt::format("{} {}", program, what));
}

void requireEnd(const std::optional<int>& status, std::string_view program) {
  if (!status) failOn(program, "was stopped: the formula takes too much time or memory");
}

void runLatex(const std::filesystem::path& latex, const std::filesystem::path& folder) {
  LimitedProcess process;
  process.program = latex;
  process.arguments = {"-no-shell-escape", "-interaction=nonstopmode", "-halt-on-error", "formula.tex"};
  process.environment = environmentIn(folder);
  process.directory = folder;
  const std::optional<int> status = run(process);
  requireEnd(status, "TeX");
  const std::string log = textOf(folder / "formula.log");
  if (*status == 0 && std::filesystem::exists(folder / "formula.dvi")) return;
  const bool incomplete = log.empty() || log.find("LaTeX Error: File `ams") != std::string::npos;
  if (incomplete)
    throw Error(ExitCode::Environment,
                fmt::format("TeX is not whole: install the packages {}", kTexPackages));
  throw Error(ExitCode::BadInput, *status == 0 ? "it shows nothing" : problemIn(log));
}

Image runDvipng(const std::filesystem::path& dvipng, const std::filesystem::path& folder, double size) {
  const double dpi = size * kCapitals / kFontPoints * kPointsPerInch * kOversampling;
  LimitedProcess process;
  process.program = dvipng;
  process.arguments = {"--noghostscript",
                       "-D",
                       fmt::format("{:.0f}", std::round(dpi)),
                       "-T",
                       "tight",
                       "-bg",
                       "White",
                       "-fg",
                       "Black",
                       "-p",
                       "1",
                       "-l",
                       "1",
                       "-o",
                       "formula.png",
                       "formula.dvi"};
  process.environment = environmentIn(folder);
  process.output = kDvipngLog;
  process.directory = folder;
  const std::optional<int> status = run(process);
  requireEnd(status, "dvipng");
  if (*status != 0) failOn("dvipng", "cannot draw it");
  if (textOf(folder / kDvipngLog).find("will be left blank") != std::string::npos)
    throw Error(ExitCode::BadInput, "it asks for a font of TeX's that is not installed");
  try {
    return loadImage(folder / "formula.png");
  } catch (const Error&) {
    failOn("dvipng", "cannot draw it");
  }
}

/// The mean darkness of kOversampling² pixels each.
Mask maskOf(const Image& image) {
  Mask mask;
  mask.width = (image.width + kOversampling - 1) / kOversampling;
  mask.height = (image.height + kOversampling - 1) / kOversampling;
  std::vector<int> sums(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto from =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
      const auto to = static_cast<std::size_t>(y / kOversampling) * static_cast<std::size_t>(mask.width) +
                      static_cast<std::size_t>(x / kOversampling);
      sums[to] += 255 - image.rgba[4 * from];
    }
  }
  constexpr int kSamples = kOversampling * kOversampling;
  bool ink = false;
  for (const int sum : sums) {
    mask.coverage.push_back(static_cast<std::uint8_t>((sum + kSamples / 2) / kSamples));
    ink = ink || sum > 0;
  }
  if (!ink) throw Error(ExitCode::BadInput, "it shows nothing");
  return mask;
}

} // namespace

std::string texPrograms() {
  const auto latex = findProgram("latex");
  const auto dvipng = findProgram("dvipng");
  if (!latex || !dvipng) return "";
  return latex->string() + ", " + dvipng->string();
}

Mask typeset(const std::string& formula, double size, const FormulaCache& cache) {
  const std::string document = documentOf(formula);
  const std::string content = fmt::format("{} px\n{}", size, document);
  if (auto kept = cache.find(content)) return std::move(*kept);
  const auto latex = findProgram("latex");
  const auto dvipng = findProgram("dvipng");
  if (!latex || !dvipng)
    throw Error(ExitCode::Environment,
                fmt::format("a formula is typeset by {}, which is missing; install the packages {}",
                            latex ? "dvipng" : "latex", kTexPackages));
  const WorkFolder folder;
  std::ofstream(folder.path() / "formula.tex", std::ios::binary) << document;
  runLatex(*latex, folder.path());
  Mask mask = maskOf(runDvipng(*dvipng, folder.path(), size));
  cache.put(content, mask);
  return mask;
}

} // namespace offstage
