#include "src/sim/contact.h"

#include "src/sim/force_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace offstage {
namespace {

// Unit vectors by Side: out of a rectangle's left, right, top, bottom side.
const std::array<Vec2, 4>& outwardNormals() {
  static const std::array<Vec2, 4> kNormals{Vec2(-1.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, -1.0), Vec2(0.0, 1.0)};
  return kNormals;
}

std::optional<Contact> betweenCircles(const Body& first, const Body& second, double reach) {
  const Vec2 d = second.position - first.position;
  const double distance = length(d);
  const double touch = first.radius + second.radius;
  if (!(distance < touch + reach)) return std::nullopt;
  return Contact{distance > 0.0 ? Vec2(d / distance) : Vec2(1.0, 0.0), distance, touch};
}

/// With the normal from the rectangle to the circle.
std::optional<Contact> betweenRectangleAndCircle(const Body& rectangle, const Body& circle, double reach) {
  const Vec2& low = rectangle.position;
  const Vec2 high = low + rectangle.size;
  const Vec2& c = circle.position;
  const std::array<double, 4> depths{c.x() - low.x(), high.x() - c.x(), c.y() - low.y(), high.y() - c.y()};
  if (std::any_of(depths.begin(), depths.end(), [](double depth) { return std::isnan(depth); }))
    return std::nullopt;
  const auto nearest = std::min_element(depths.begin(), depths.end()); // the first of equals
  const auto sideNormal = [&] {
    return outwardNormals()[static_cast<std::size_t>(nearest - depths.begin())];
  };
  if (*nearest >= 0.0) {                                           // the centre is inside
    if (!(-*nearest < circle.radius + reach)) return std::nullopt; // a point on the edge
    return Contact{sideNormal(), -*nearest, circle.radius};
  }
  const Vec2 closest(std::clamp(c.x(), low.x(), high.x()), std::clamp(c.y(), low.y(), high.y()));
  const Vec2 d = c - closest;
  const double distance = length(d);
  if (!(distance < circle.radius + reach)) return std::nullopt;
  // Nearer than a double's square can tell from 0, the nearest side gives the direction.
  return Contact{distance > 0.0 ? Vec2(d / distance) : sideNormal(), distance, circle.radius};
}

std::optional<Contact> betweenRectangles(const Body& first, const Body& second, double reach) {
  const Vec2& low = first.position;
  const Vec2 high = low + first.size;
  const Vec2& otherLow = second.position;
  const Vec2 otherHigh = otherLow + second.size;
  // How far the second would have to go to get out to the left, right, top, bottom.
  const std::array<double, 4> ways{otherHigh.x() - low.x(), high.x() - otherLow.x(), otherHigh.y() - low.y(),
                                   high.y() - otherLow.y()};
  const auto least = std::min_element(ways.begin(), ways.end()); // the first of equals
  if (!std::all_of(ways.begin(), ways.end(), [&](double way) { return way > -reach; })) return std::nullopt;
  return Contact{outwardNormals()[static_cast<std::size_t>(least - ways.begin())], -*least, 0.0};
}

Vec2 velocityOf(const Body& body) {
  return body.fixed ? Vec2::Zero() : body.velocity;
}

/// Brings the tangential speeds of two bodies nearer to each other, as far as friction reaches. `changed`: by
/// how much their closing speed has changed.
void rub(double friction, double changed, const Body& first, const Body& second, double& v1t, double& v2t) {
  const double w1 = first.fixed ? 0.0 : 1.0 / first.mass;
  const double w2 = second.fixed ? 0.0 : 1.0 / second.mass;
  if (!(w1 + w2 > 0.0)) return;
  const double most = friction * std::abs(changed);
  const double slip = std::clamp(v2t - v1t, -most, most);
  v1t += slip * (w1 / (w1 + w2));
  v2t -= slip * (w2 / (w1 + w2));
}

} // namespace

double pairOf(double first, double second) {
  return first == second ? first : std::sqrt(first * second);
}

std::optional<Contact> findContact(const Body& first, const Body& second, double reach) {
  const bool firstIsCircle = first.shape == Shape::Circle;
  const bool secondIsCircle = second.shape == Shape::Circle;
  if (firstIsCircle && secondIsCircle) return betweenCircles(first, second, reach);
  if (!firstIsCircle && !secondIsCircle) return betweenRectangles(first, second, reach);
  if (secondIsCircle) return betweenRectangleAndCircle(first, second, reach);
  std::optional<Contact> contact = betweenRectangleAndCircle(second, first, reach);
  if (contact) contact->normal = -contact->normal;
  return contact;
}

double closingSpeed(const Contact& contact, const Body& first, const Body& second) {
  return dot(velocityOf(first), contact.normal) - dot(velocityOf(second), contact.normal);
}

bool responds(const ContactRule& rule, const Contact& contact, const Body& first, const Body& second) {
  if (first.fixed && second.fixed) return false;
  if (!rule.approachingOnly) return true;
  return dot(velocityOf(first), contact.normal) > dot(velocityOf(second), contact.normal);
}

void respond(const ContactRule& rule, const Contact& contact, Body& first, Body& second) {
  const Vec2& n = contact.normal;
  const Vec2 t(-n.y(), n.x());
  const Vec2 v1 = velocityOf(first);
  const Vec2 v2 = velocityOf(second);
  double v1t = dot(v1, t);
  const double v1n = dot(v1, n);
  double v2t = dot(v2, t);
  const double v2n = dot(v2, n);
  Vec2 new1;
  Vec2 new2;
  if (rule.response == Response::Slide) {
    const Vec2 n1 = n * v1n;
    const Vec2 n2 = n * v2n;
    new1 = (t * v1t + n1) - n2;
    new2 = (t * v2t + n2) - n1;
  } else {
    double after1 = v2n;
    double after2 = v1n;
    const double m1 = first.mass;
    const double m2 = second.mass;
    const double restitution = rule.restitution * pairOf(first.restitution, second.restitution);
    const double returned = restitution * (v1n - v2n);
    if (first.fixed || second.fixed) {
      after1 = v2n - returned; // the speed of the fixed one, 0, and what comes back
      after2 = v1n + returned;
    } else if (m1 != m2 || restitution != 1.0) {
      const double momentum = m1 * v1n + m2 * v2n;
      after1 = (momentum - m2 * returned) / (m1 + m2);
      after2 = (momentum + m1 * returned) / (m1 + m2);
    }
    const double friction = pairOf(first.friction, second.friction);
    if (friction > 0.0) rub(friction, (v1n - v2n) + returned, first, second, v1t, v2t);
    new1 = t * v1t + n * after1;
    new2 = t * v2t + n * after2;
  }
  if (!first.fixed) first.velocity = new1;
  if (!second.fixed) second.velocity = new2;
}

void separate(const Contact& contact, Body& first, Body& second) {
  if (first.fixed && second.fixed) return;
  const double overlap = contact.touch - contact.distance;
  const Vec2 push = contact.normal * (first.fixed || second.fixed ? overlap : overlap * 0.5);
  if (!first.fixed) first.position -= push;
  if (!second.fixed) second.position += push;
}

} // namespace offstage
