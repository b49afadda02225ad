#pragma once

#include "src/scene/look.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace offstage {

/// The looks of a scene, equal ones only once: thousands of bodies share a handful, and the drawing stage
/// prepares each look once.
class LookTable {
public:
  /// The look's index into looks().
  std::uint32_t add(const Look& look);
  [[nodiscard]] std::vector<Look> take() { return std::move(looks_); }

private:
  std::vector<Look> looks_;
  std::map<std::string, std::uint32_t> indices_; ///< by everything that a look draws
};

} // namespace offstage
