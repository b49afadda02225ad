#include "src/scene/range.h"

#include "src/scene/quote.h"

#include <cmath>

namespace offstage {

std::string Range::text() const {
  const bool bounded = std::isfinite(high);
  if (!std::isfinite(low)) return bounded ? "at most " + numberText(high) : "a finite number";
  if (!bounded) return (lowIncluded ? "at least " : "greater than ") + numberText(low);
  if (lowIncluded) return "from " + numberText(low) + " to " + numberText(high);
  return "greater than " + numberText(low) + " and at most " + numberText(high);
}

} // namespace offstage
