#include "render/draw/font_library.h"

#include "render/draw/file_bytes.h"
#include "src/scene/diagnostic.h"

#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::size_t kLargestFontFile = 128UL << 20U; ///< the largest collections for Chinese hold less

constexpr std::string_view nameOf(Typeface typeface) {
  switch (typeface) {
  case Typeface::Sans:
    return "DejaVuSans.ttf";
  case Typeface::SansBold:
    return "DejaVuSans-Bold.ttf";
  case Typeface::Mono:
    return "DejaVuSansMono.ttf";
  case Typeface::MonoBold:
    return "DejaVuSansMono-Bold.ttf";
  }
  return "";
}

std::shared_ptr<const Font> readFont(const FontChoice& choice, const std::filesystem::path& file) {
  try {
    return std::make_shared<const Font>(readFileBytes(file, kLargestFontFile));
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    if (choice.file.empty())
      throw Error(ExitCode::Environment, fmt::format("the font {}: {}; install the package {}", file.string(),
                                                     error.what(), kFontPackage));
    const std::string message = fmt::format("the font {} {}", file.string(), error.what());
    if (choice.where.file.empty()) throw Error(ExitCode::BadInput, message);
    throw SceneError({{choice.where, message}});
  }
}

} // namespace

std::filesystem::path typefaceFile(Typeface typeface) {
  const char* folder = std::getenv("OFFSTAGE_FONTS"); // NOLINT(concurrency-mt-unsafe)
  return std::filesystem::path(folder != nullptr ? folder : "/usr/share/fonts/truetype/dejavu") /
         nameOf(typeface);
}

std::filesystem::path fontFile(const FontChoice& choice) {
  return choice.file.empty() ? typefaceFile(choice.typeface) : choice.file;
}

std::shared_ptr<const Font> FontLibrary::get(const FontChoice& choice) {
  const std::filesystem::path file = fontFile(choice);
  std::shared_ptr<const Font>& font = fonts_[file];
  if (font == nullptr) font = readFont(choice, file);
  return font;
}

} // namespace offstage
