#pragma once

#include "render/draw/text_painter.h"
#include "src/scene/scene.h"

namespace offstage {

/// Throws SceneError where the font lacks a character of what a scene writes beside its [[text]]s and title
/// cards: titles, labels and names of its plots, titles of its panels, units of its rulers. Names all of
/// them.
void requireGlyphs(const Scene& scene, const TextPainter& texts);

} // namespace offstage
