#include "render/draw/font.h"

#include "render/draw/gpos_kerning.h"
#include "src/sim/error.h"

#include <algorithm>
#include <ft2build.h>
#include <stdexcept>
#include FT_ADVANCES_H
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr FT_ULong kGpos = 0x47504f53U; // "GPOS"

/// The first four bytes of what is read: TrueType, OpenType with CFF outlines, Apple's TrueType, a
/// collection.
bool isSfnt(const std::vector<std::uint8_t>& bytes) {
  constexpr std::uint32_t kTags[] = {0x00010000U, 0x4f54544fU, 0x74727565U, 0x74746366U};
  if (bytes.size() < 12) return false;
  const std::uint32_t tag =
      static_cast<std::uint32_t>(bytes[0]) << 24U | bytes[1] << 16U | bytes[2] << 8U | bytes[3];
  return std::find(std::begin(kTags), std::end(kTags), tag) != std::end(kTags);
}

Vec2 toVec2(const FT_Vector* v) {
  return {static_cast<double>(v->x), static_cast<double>(v->y)};
}

GlyphOutline& outlineIn(void* user) {
  return *static_cast<GlyphOutline*>(user);
}

int moveTo(const FT_Vector* to, void* user) {
  outlineIn(user).contours.push_back({toVec2(to), {}});
  return 0;
}

int append(void* user, const GlyphOutline::Segment& segment) {
  GlyphOutline& outline = outlineIn(user);
  if (outline.contours.empty()) return 1; // no outline begins so
  outline.contours.back().segments.push_back(segment);
  return 0;
}

int lineTo(const FT_Vector* to, void* user) {
  return append(user, {.controls = 0, .to = toVec2(to)});
}

int conicTo(const FT_Vector* control, const FT_Vector* to, void* user) {
  return append(user, {.controls = 1, .through = {toVec2(control), Vec2::Zero()}, .to = toVec2(to)});
}

int cubicTo(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
  return append(user, {.controls = 2, .through = {toVec2(first), toVec2(second)}, .to = toVec2(to)});
}

} // namespace

struct Font::Face {
  std::vector<std::uint8_t> bytes; ///< FreeType reads from them as long as the face lives
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  GposKerning kerning;

  explicit Face(std::vector<std::uint8_t> file) : bytes(std::move(file)) {}
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  ~Face() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }

  void load(std::uint32_t glyph) const {
    const FT_Error error = FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_IGNORE_TRANSFORM);
    if (error == 0 && face->glyph->format == FT_GLYPH_FORMAT_OUTLINE) return;
    throw Error(ExitCode::BadInput,
                fmt::format("the font {} is damaged: its glyph {} cannot be read",
                            face->family_name != nullptr ? face->family_name : "", glyph));
  }
};

Font::Font(std::vector<std::uint8_t> bytes) : face_(std::make_unique<Face>(std::move(bytes))) {
  if (!isSfnt(face_->bytes)) throw std::runtime_error("is no TrueType or OpenType font");
  if (FT_Init_FreeType(&face_->library) != 0)
    throw std::runtime_error("cannot be read: FreeType does not start");
  const auto size = static_cast<FT_Long>(face_->bytes.size());
  if (FT_New_Memory_Face(face_->library, face_->bytes.data(), size, 0, &face_->face) != 0)
    throw std::runtime_error("is a damaged font");
  if (!FT_IS_SCALABLE(face_->face)) throw std::runtime_error("is a font of bitmaps, without outlines");
  if (FT_Select_Charmap(face_->face, FT_ENCODING_UNICODE) != 0)
    throw std::runtime_error("is a font without a table of Unicode characters");
  if (face_->face->units_per_EM == 0 || ascent() + descent() <= 0)
    throw std::runtime_error("is a damaged font (its letters have no height)");

  FT_ULong length = 0;
  if (FT_Load_Sfnt_Table(face_->face, kGpos, 0, nullptr, &length) != 0 || length > face_->bytes.size())
    return;
  std::vector<std::uint8_t> gpos(length);
  if (FT_Load_Sfnt_Table(face_->face, kGpos, 0, gpos.data(), &length) == 0)
    face_->kerning = GposKerning(std::move(gpos));
}

Font::~Font() = default;

std::uint32_t Font::glyph(char32_t character) const {
  return FT_Get_Char_Index(face_->face, character);
}

int Font::unitsPerEm() const {
  return face_->face->units_per_EM;
}

int Font::ascent() const {
  return face_->face->ascender;
}

int Font::descent() const {
  return -face_->face->descender;
}

int Font::advance(std::uint32_t glyph) const {
  FT_Fixed advance = 0;
  if (FT_Get_Advance(face_->face, glyph, FT_LOAD_NO_SCALE, &advance) != 0)
    throw Error(ExitCode::BadInput,
                fmt::format("a font is damaged: the width of its glyph {} is broken", glyph));
  return static_cast<int>(advance);
}

int Font::kerning(std::uint32_t left, std::uint32_t right) const {
  if (!face_->kerning.empty()) return face_->kerning.between(left, right);
  FT_Vector kerning{};
  if (!FT_HAS_KERNING(face_->face) ||
      FT_Get_Kerning(face_->face, left, right, FT_KERNING_UNSCALED, &kerning) != 0)
    return 0;
  return static_cast<int>(kerning.x);
}

GlyphOutline Font::outline(std::uint32_t glyph) const {
  face_->load(glyph);
  constexpr FT_Outline_Funcs kFunctions{moveTo, lineTo, conicTo, cubicTo, 0, 0};
  GlyphOutline outline;
  if (FT_Outline_Decompose(&face_->face->glyph->outline, &kFunctions, &outline) != 0)
    throw Error(ExitCode::BadInput,
                fmt::format("a font is damaged: the outline of its glyph {} is broken", glyph));
  return outline;
}

} // namespace offstage
