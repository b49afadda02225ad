#include "src/scene/look_table.h"

#include <array>
#include <bit>
#include <cstdint>
#include <string>

namespace offstage {
namespace {

// An identity is bytes: what a look has by a letter each, followed by its numbers, all of a fixed size.

/// Numbers by their bits: two looks are equal when they draw the same, to the bit.
void appendNumber(std::string& identity, double value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
  identity.append(bytes.data(), bytes.size());
}

void appendPaint(std::string& identity, const Paint& paint) {
  if (const auto* color = std::get_if<Color>(&paint)) {
    identity += 'c';
    for (const int channel : {color->red, color->green, color->blue}) appendNumber(identity, channel);
    appendNumber(identity, color->alpha);
    return;
  }
  // Where the image was named is left out: it is for messages only.
  const auto& pattern = std::get<ImagePattern>(paint);
  const std::string file = pattern.file.string();
  identity += 'i';
  appendNumber(identity, static_cast<double>(file.size()));
  identity += file;
  identity += pattern.proportional ? 'p' : 'f';
  for (const double number : pattern.anchor) appendNumber(identity, number);
}

} // namespace

std::uint32_t LookTable::add(const Look& look) {
  std::string identity;
  appendNumber(identity, look.opacity);
  if (look.fill) {
    identity += 'f';
    appendPaint(identity, *look.fill);
  }
  if (look.stroke) {
    identity += 's';
    identity += static_cast<char>('0' + static_cast<int>(look.stroke->align));
    appendNumber(identity, look.stroke->width);
    appendPaint(identity, look.stroke->paint);
  }
  const auto [place, isNew] = indices_.try_emplace(identity, static_cast<std::uint32_t>(looks_.size()));
  if (isNew) looks_.push_back(look);
  return place->second;
}

} // namespace offstage
