#pragma once

#include <span>
#include <string_view>

namespace offstage {

/// The candidate that `text` is most likely a typo of, or an empty view when none is near. Near means: few
/// letters inserted, left out, replaced or swapped with their neighbour (optimal string alignment distance,
/// letter case ignored), at most one for short words and a third of the letters for long ones. The first of
/// equally near candidates wins.
std::string_view nearest(std::string_view text, std::span<const std::string_view> candidates);

} // namespace offstage
