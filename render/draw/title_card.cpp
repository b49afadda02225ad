#include "render/draw/title_card.h"

#include "render/draw/fit_text.h"

#include <algorithm>
#include <string>
#include <vector>

namespace offstage {
namespace {

// Shares of the pane's height.
constexpr double kTitleSize = 1.0 / 10.0;
constexpr double kSubtitleSize = 1.0 / 20.0;
constexpr double kSubtitleBelow = 1.0 / 9.0; ///< the distance between the middles of the two lines
constexpr double kMargin = 0.08;             ///< of the pane's width, on either side
constexpr double kLeastSize = 4.0;           ///< px

TextLook lookOf(Typeface typeface, double size, const Color& color) {
  TextLook look;
  look.font.typeface = typeface;
  look.size = std::max(size, kLeastSize);
  look.color = color;
  return look;
}

} // namespace

TitleCard::TitleCard(const Scene& scene, const Viewport& viewport)
    : pane_(scene.size[0], scene.size[1]),
      clip_(viewport.clip),
      background_(scene.background),
      titleLook_(lookOf(Typeface::SansBold, kTitleSize * scene.size[1], scene.theme.text)),
      subtitleLook_(lookOf(Typeface::Sans, kSubtitleSize * scene.size[1], scene.theme.muted)),
      painter_(viewport) {
  background_.alpha = 1.0;
  std::vector<Diagnostic> problems;
  for (const Section& section : scene.timeline.sections) {
    if (section.card == 0.0) continue;
    try {
      painter_.require(titleLook_, section.title);
      if (!section.subtitle.empty()) painter_.require(subtitleLook_, section.subtitle);
    } catch (const Error& error) {
      if (error.code() != ExitCode::BadInput) throw;
      problems.push_back({section.where, "the title card of [[section]]: " + std::string(error.what())});
    }
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
}

void TitleCard::draw(Picture& picture, std::string_view title, std::string_view subtitle,
                     double share) const {
  Primitive ground;
  ground.kind = Primitive::Kind::Box;
  ground.color = {background_.red, background_.green, background_.blue, background_.alphaByte(share)};
  ground.low = Vec2(clip_.left, clip_.top);
  ground.high = Vec2(clip_.right, clip_.bottom);
  picture.primitives.push_back(ground);
  const Vec2 middle = pane_ * 0.5;
  const Vec2 down(0.0, 0.5 * kSubtitleBelow * pane_.y());
  const auto line = [&](std::string_view text, const TextLook& look, const Vec2& at) {
    const FittedText fitted = fitText(painter_, text, look, pane_.x() * (1.0 - 2.0 * kMargin), kLeastSize);
    painter_.draw(picture, fitted.text, fitted.look, at, share);
  };
  line(title, titleLook_, subtitle.empty() ? middle : Vec2(middle - down));
  if (!subtitle.empty()) line(subtitle, subtitleLook_, middle + down);
}

} // namespace offstage
