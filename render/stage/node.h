#pragma once

#include "src/scene/look.h"
#include "src/sim/body.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace offstage {

class Stage;

/// A shape on a stage, as JavaFX has them. Circle, Rectangle and GameObject are handles: a copy is the same
/// shape, so that `stage.add(ball); ball.setCenterY(100);` moves what is drawn. A shape may be made, changed
/// and kept whether or not it is on a stage at the moment.
class Node {
public:
  /// What fills the shape: a Color or an ImagePattern. Black at first.
  void setFill(const Paint& fill);
  void setNoFill();
  /// The outline's paint; a stroke without a width is 1 px wide, centred on the edge. None at first.
  void setStroke(const Paint& stroke);
  void setNoStroke();
  void setStrokeWidth(double width); ///< px, ≥ 0
  void setStrokeAlign(StrokeAlign align);
  void setOpacity(double opacity); ///< 0 … 1, multiplies fill and stroke
  void setVisible(bool visible);   ///< an invisible shape stays on the stage

  [[nodiscard]] const Look& look() const { return state_->look; }
  [[nodiscard]] double opacity() const { return state_->look.opacity; }
  [[nodiscard]] bool visible() const { return state_->visible; }

  /// The same shape, not one that looks the same.
  friend bool operator==(const Node& a, const Node& b) { return a.state_ == b.state_; }

protected:
  struct State {
    Shape shape = Shape::Circle;
    Vec2 position = Vec2::Zero();     ///< px: centre or upper-left corner
    Vec2 size = Vec2::Zero();         ///< px
    double radius = 0.0;              ///< px
    Vec2 velocity = Vec2::Zero();     ///< px/s; of game objects
    Vec2 acceleration = Vec2::Zero(); ///< px/s²; of game objects
    Look look;
    Stroke strokeStyle; ///< width and alignment, also while there is no stroke
    bool visible = true;
    std::uint64_t lookVersion = 0; ///< counts changes of the look, so that the stage prepares each only once
  };

  Node(Shape shape, const Vec2& position, double radius, const Vec2& size, const Paint& fill);
  [[nodiscard]] State& state() { return *state_; }
  [[nodiscard]] const State& state() const { return *state_; }

private:
  friend class Stage;
  friend class StageSource;
  std::shared_ptr<State> state_;
};

/// A circle: centre and radius in px, y down.
class Circle : public Node {
public:
  Circle(double centerX, double centerY, double radius, const Paint& fill = Color{});

  [[nodiscard]] double centerX() const { return state().position.x(); }
  [[nodiscard]] double centerY() const { return state().position.y(); }
  [[nodiscard]] Vec2 center() const { return state().position; }
  [[nodiscard]] double radius() const { return state().radius; }
  void setCenterX(double x) { state().position.x() = x; }
  void setCenterY(double y) { state().position.y() = y; }
  void setCenter(const Vec2& center) { state().position = center; }
  void setRadius(double radius) { state().radius = radius; }
};

/// An axis-aligned rectangle: upper-left corner, width and height in px, y down.
class Rectangle : public Node {
public:
  Rectangle(double x, double y, double width, double height, const Paint& fill = Color{});

  [[nodiscard]] double x() const { return state().position.x(); }
  [[nodiscard]] double y() const { return state().position.y(); }
  [[nodiscard]] double width() const { return state().size.x(); }
  [[nodiscard]] double height() const { return state().size.y(); }
  void setX(double x) { state().position.x() = x; }
  void setY(double y) { state().position.y() = y; }
  void setWidth(double width) { state().size.x() = width; }
  void setHeight(double height) { state().size.y() = height; }
};

} // namespace offstage
