#pragma once

#include "render/draw/font.h"
#include "src/scene/text_look.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string_view>

namespace offstage {

/// The Debian package of the typefaces.
inline constexpr std::string_view kFontPackage = "fonts-dejavu-core";

/// Where a typeface's file is expected: in the folder that the environment variable OFFSTAGE_FONTS names, or
/// where Debian's package puts it.
std::filesystem::path typefaceFile(Typeface typeface);

/// The file that a choice means.
std::filesystem::path fontFile(const FontChoice& choice);

/// Fonts by file, each read once. Not thread-safe.
class FontLibrary {
public:
  /// Throws Error(Environment) naming the package when a typeface is missing; SceneError (located) or
  /// Error(BadInput) when a file of the user's cannot be read or is no sound font.
  std::shared_ptr<const Font> get(const FontChoice& choice);

private:
  std::map<std::filesystem::path, std::shared_ptr<const Font>> fonts_;
};

} // namespace offstage
