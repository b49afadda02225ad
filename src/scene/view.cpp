#include "src/scene/view.h"

namespace offstage {

View::View(double pixelsPerUnit, const Vec2& origin, bool yUp)
    : scale_(pixelsPerUnit), yScale_(yUp ? -pixelsPerUnit : pixelsPerUnit), origin_(origin) {}

double View::attraction(double strength) const {
  return scale_ == 1.0 ? strength : scale_ * scale_ * scale_ * strength;
}

double View::perLength(double value) const {
  return scale_ == 1.0 ? value : value / scale_;
}

ForceState View::toScene(const ForceState& state) const {
  if (isIdentity()) return state;
  ForceState scene = state;
  scene.position = {(state.position.x() - origin_.x()) / scale_,
                    (state.position.y() - origin_.y()) / yScale_};
  scene.velocity = {state.velocity.x() / scale_, state.velocity.y() / yScale_};
  return scene;
}

std::optional<Number> mapped(const Number& number, const AffineMap& map) {
  struct Apply {
    AffineMap map;
    std::optional<Number> operator()(const ConstantNumber& n) const { return ConstantNumber{map(n.value)}; }
    std::optional<Number> operator()(const IntegerNumber& /*n*/) const { return std::nullopt; }
    std::optional<Number> operator()(const SpreadNumber& n) const {
      if (map.offset == 0.0) return SpreadNumber{map.scale * n.half};
      return UniformNumber{map(-n.half), map(n.half)};
    }
    std::optional<Number> operator()(const UniformNumber& n) const {
      return UniformNumber{map(n.low), map(n.high)};
    }
    std::optional<Number> operator()(const GaussianNumber& n) const {
      return GaussianNumber{map(n.mean), map.scale * n.deviation};
    }
  };
  if (map.isIdentity()) return number;
  return std::visit(Apply{map}, number);
}

} // namespace offstage
