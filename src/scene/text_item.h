#pragma once

#include "src/scene/text_look.h"
#include "src/scene/text_template.h"
#include "src/sim/force.h"

#include <limits>
#include <optional>
#include <string>

namespace offstage {

/// `[[text]]`.
struct TextItem {
  TextTemplate text;   ///< empty when there is a formula
  std::string formula; ///< TeX, or empty
  TextLook look;
  std::optional<NinePosition> place;                   ///< of the pane, an em from its edges; or else
  Anchor at;                                           ///< a point or a body, px
  Vec2 offset = Vec2::Zero();                          ///< px, from there; y down
  double from = 0.0;                                   ///< s: shown from here on
  double to = std::numeric_limits<double>::infinity(); ///< s: gone from here on
  double fade = 0.0;    ///< s: how long it takes to come and, before `to`, to go
  SourceLocation where; ///< of the text or the formula
};

/// How much of an item is seen at a time (s): 0 … 1.
double shownShare(const TextItem& item, double time);

} // namespace offstage
