#include "render/stage/node.h"

namespace offstage {

Node::Node(Shape shape, const Vec2& position, double radius, const Vec2& size, const Paint& fill)
    : state_(std::make_shared<State>()) {
  state_->shape = shape;
  state_->position = position;
  state_->radius = radius;
  state_->size = size;
  state_->look.fill = fill;
}

void Node::setFill(const Paint& fill) {
  state_->look.fill = fill;
  ++state_->lookVersion;
}

void Node::setNoFill() {
  state_->look.fill.reset();
  ++state_->lookVersion;
}

void Node::setStroke(const Paint& stroke) {
  state_->strokeStyle.paint = stroke;
  state_->look.stroke = state_->strokeStyle;
  ++state_->lookVersion;
}

void Node::setNoStroke() {
  state_->look.stroke.reset();
  ++state_->lookVersion;
}

void Node::setStrokeWidth(double width) {
  state_->strokeStyle.width = width;
  if (state_->look.stroke) state_->look.stroke->width = width;
  ++state_->lookVersion;
}

void Node::setStrokeAlign(StrokeAlign align) {
  state_->strokeStyle.align = align;
  if (state_->look.stroke) state_->look.stroke->align = align;
  ++state_->lookVersion;
}

void Node::setOpacity(double opacity) {
  state_->look.opacity = opacity;
  ++state_->lookVersion;
}

void Node::setVisible(bool visible) {
  state_->visible = visible;
}

Circle::Circle(double centerX, double centerY, double radius, const Paint& fill)
    : Node(Shape::Circle, Vec2(centerX, centerY), radius, Vec2::Zero(), fill) {}

Rectangle::Rectangle(double x, double y, double width, double height, const Paint& fill)
    : Node(Shape::Rectangle, Vec2(x, y), 0.0, Vec2(width, height), fill) {}

} // namespace offstage
