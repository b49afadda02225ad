#include "render/draw/fit_text.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace offstage {
namespace {

constexpr std::string_view kEllipsis = "…";

double lengthOf(const TextPainter& painter, std::string_view text, const TextLook& look) {
  const Vec2 size = painter.measure(text, look);
  return look.upwards ? size.y() : size.x();
}

/// The places at which UTF-8 may be cut: before each of its characters.
std::vector<std::size_t> cutsOf(std::string_view line) {
  std::vector<std::size_t> cuts;
  for (std::size_t i = 0; i < line.size(); ++i)
    if ((static_cast<unsigned char>(line[i]) & 0xC0U) != 0x80U) cuts.push_back(i);
  return cuts;
}

std::string cutAt(std::string_view line, std::size_t end) {
  while (end > 0 && line[end - 1] == ' ') --end;
  return std::string(line.substr(0, end)).append(kEllipsis);
}

std::string shortened(const TextPainter& painter, std::string_view line, const TextLook& look, double room) {
  if (lengthOf(painter, line, look) <= room) return std::string(line);
  const std::vector<std::size_t> cuts = cutsOf(line);
  const auto isTooLong = [&](std::size_t cut) { return lengthOf(painter, cutAt(line, cut), look) > room; };
  const auto first = std::ranges::partition_point(cuts, [&](std::size_t cut) { return !isTooLong(cut); });
  return first == cuts.begin() ? std::string() : cutAt(line, *std::prev(first));
}

} // namespace

FittedText fitText(const TextPainter& painter, std::string_view text, TextLook look, double room,
                   double least, double beside) {
  const double width = lengthOf(painter, text, look) + beside * look.size;
  if (!(width > room)) return {std::string(text), look};
  const double needed = look.size * room / width;
  look.size = std::max(needed, least);
  if (needed >= least) return {std::string(text), look};
  std::string result;
  for (std::string_view rest = text;;) {
    const std::size_t end = rest.find('\n');
    result += shortened(painter, rest.substr(0, end), look, room - beside * look.size);
    if (end == std::string_view::npos) break;
    result += '\n';
    rest.remove_prefix(end + 1);
  }
  return {result, look};
}

} // namespace offstage
