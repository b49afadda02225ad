#include "src/scene/text_template.h"

#include <algorithm>

namespace offstage {

bool TextTemplate::live() const {
  return std::any_of(pieces.begin(), pieces.end(),
                     [](const Piece& piece) { return piece.probe.has_value(); });
}

std::string TextTemplate::text(const Snapshot& snapshot) const {
  std::string whole;
  for (const Piece& piece : pieces) {
    whole += piece.text;
    if (piece.probe) whole += piece.format.text(valueOf(*piece.probe, snapshot));
  }
  return whole;
}

} // namespace offstage
