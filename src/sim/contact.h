#pragma once

#include "src/sim/body.h"
#include "src/sim/world_setup.h"

#include <optional>

namespace offstage {

/// Two bodies that touch. For every pair of shapes the same three numbers, so that one response serves all.
///
///   circle, circle        distance of the centres; touch = r1 + r2; normal from centre to centre, (1, 0)
///   when they
///                         coincide
///   circle, rectangle     distance from the circle's centre to the rectangle's nearest point; touch = r.
///   With the
///                         centre in the rectangle the distance is negative, the depth below its nearest
///                         side, and the normal is that side's
///   rectangle, rectangle  minus the least push along an axis that parts them; touch = 0; the normal is that
///   axis
///
/// Of equally near sides the first of left, right, top, bottom counts (the circle's, or the second
/// rectangle's, way out of the other).
struct Contact {
  Vec2 normal;     ///< of length 1, from the first body to the second
  double distance; ///< px
  double touch; ///< px: they touch while distance < touch, strictly; touch − distance is how far they overlap
};

/// The contact of two bodies, or nothing when they do not touch (or when a coordinate is NaN). With a `reach`
/// (px) above 0 also of bodies whose gap, distance − touch, is below it.
std::optional<Contact> findContact(const Body& first, const Body& second, double reach = 0.0);

/// What two bodies have of a property of their material: the geometric mean, exactly so when they are equal.
double pairOf(double first, double second);

/// Whether a contact changes velocities by this rule: while approaching, v1n > v2n, or always. A fixed body
/// counts as at rest; two of them have nothing to change.
bool responds(const ContactRule& rule, const Contact& contact, const Body& first, const Body& second);

/// v1n − v2n, px/s: positive while approaching.
double closingSpeed(const Contact& contact, const Body& first, const Body& second);

/// New velocities of two touching bodies by Response::Bounce or Response::Slide. With the unit normal n and
/// tangent t = (−n.y, n.x), and vt, vn a velocity's components along them:
///
/// Bounce  the tangential parts stay. Of the normal parts, momentum m1·v1n + m2·v2n is kept and the closing
/// speed
///         comes back times the restitution e (Newton's law of impact; Goldsmith, Impact, section 2.1):
///           v1n' = (m1·v1n + m2·v2n − m2·e·(v1n − v2n))/(m1 + m2), v2n' = (… + m1·e·(v1n − v2n))/(m1 + m2).
///         Equal masses with e = 1 exchange them, which is done without the formula, and so without its
///         rounding:
///           v1 = t·v1t + n·v2n, v2 = t·v2t + n·v1n.
///         From a fixed body (m → ∞, at rest) v1n' = −e·v1n.
///         e is the rule's restitution times pairOf() the bodies'. With a friction f = pairOf() the bodies'
///         above 0, Coulomb's law takes from the tangential speeds' difference at most f times what the
///         normal speeds' difference changed by (Goldsmith, section 2.3); bodies do not rotate.
/// Slide   the lecture slide's printed formula, v1 = T1 + N1 − N2 and v2 = T2 + N2 − N1 with the vectors
///         T = t·vt, N = n·vn. It is not physical: it keeps neither momentum nor energy, and doubles the
///         closing speed of a pair.
///
/// A fixed body keeps its velocity.
void respond(const ContactRule& rule, const Contact& contact, Body& first, Body& second);

/// Moves two overlapping bodies apart along the normal, half the overlap each; a fixed body's half goes to
/// the other.
void separate(const Contact& contact, Body& first, Body& second);

} // namespace offstage
