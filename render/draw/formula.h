#pragma once

#include "render/draw/formula_cache.h"
#include "render/draw/mask.h"

#include <string>
#include <string_view>

namespace offstage {

/// The Debian packages that formulas need.
inline constexpr std::string_view kTexPackages = "texlive-latex-base and dvipng";

/// Whether the programs that formulas need are there, and where: "/usr/bin/latex, /usr/bin/dvipng"; else "".
std::string texPrograms();

/// A formula of TeX's mathematics (amsmath and amssymb are loaded) as a mask, display style, cut to its ink.
/// `size`: px; its capitals are as high as those of DejaVu Sans at this size. TeX draws it four times as
/// large and the mask is the mean, so small letters are even.
///
/// A formula is not trusted: TeX starts no program, reads and writes only beside its own new folder, and
/// processor time, wall-clock time, memory and file sizes are limited; dvipng calls no PostScript.
///
/// Throws Error(Environment) naming the packages without TeX (unless the cache has the formula),
/// Error(BadInput) with TeX's own words when it is wrong, takes too long or shows nothing.
Mask typeset(const std::string& formula, double size, const FormulaCache& cache);

} // namespace offstage
