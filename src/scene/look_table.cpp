#include "src/scene/look_table.h"

#include <bit>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Numbers by their bits: two looks are equal when they draw the same, to the bit.
void appendNumber(std::string& identity, double value) {
  identity += fmt::format("{:x} ", std::bit_cast<std::uint64_t>(value));
}

void appendPaint(std::string& identity, const Paint& paint) {
  if (const auto* color = std::get_if<Color>(&paint)) {
    identity += fmt::format("color {} {} {} ", color->red, color->green, color->blue);
    appendNumber(identity, color->alpha);
    return;
  }
  // Where the image was named is left out: it is for messages only.
  const auto& pattern = std::get<ImagePattern>(paint);
  const std::string file = pattern.file.string();
  identity += fmt::format("image {} {} {} ", file.size(), file, pattern.proportional);
  for (const double number : pattern.anchor) appendNumber(identity, number);
}

} // namespace

std::uint32_t LookTable::add(const Look& look) {
  std::string identity;
  appendNumber(identity, look.opacity);
  if (look.fill) {
    identity += "fill ";
    appendPaint(identity, *look.fill);
  }
  if (look.stroke) {
    identity += fmt::format("stroke {} ", static_cast<int>(look.stroke->align));
    appendNumber(identity, look.stroke->width);
    appendPaint(identity, look.stroke->paint);
  }
  const auto [place, isNew] = indices_.try_emplace(identity, static_cast<std::uint32_t>(looks_.size()));
  if (isNew) looks_.push_back(look);
  return place->second;
}

} // namespace offstage
