#pragma once

#include "render/draw/text_painter.h"

#include <string>
#include <string_view>

namespace offstage {

/// A text as it is set where there is only so much room.
struct FittedText {
  std::string text;
  TextLook look;
};

/// The least share of its size that a text is shrunk to, where nothing else is said.
constexpr double kLeastShare = 0.6;

/// The text as it is, where it is at most `room` (px) long. Else it is smaller, down to `least` (px), and if
/// that is not small enough, the ends of lines that are too long give way to an ellipsis. `beside` (em): the
/// length of what stands in the line with it and shrinks with it.
FittedText fitText(const TextPainter& painter, std::string_view text, TextLook look, double room,
                   double least, double beside = 0.0);

} // namespace offstage
