#include "proxy/curvature_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hl {

namespace {

// How far a vertex sphere or an edge cylinder extends toward `tangent` (unit, across the edge): the tangent of the
// angle that the plane of the contact turns until another feature of the same primitive is the nearest. At an angle a
// the normal is cos(a) n + sin(a) tangent. The feature is the nearest while no direction from it into the primitive has
// a positive component along that normal.
double turnOf(const Contact& contact, const SceneAt& scene, const Vec3& tangent) {
  const Primitive& primitive = scene.primitive(contact.primitive);
  const auto number = static_cast<std::size_t>(contact.feature);
  const bool on_edge = contact.feature < Feature::kVertex0;
  const std::size_t here = number - static_cast<std::size_t>(on_edge ? Feature::kEdge0 : Feature::kVertex0);
  const Vec3 normal = scene.turnToObject(contact.primitive, contact.plane.normal);
  const Vec3 toward = scene.turnToObject(contact.primitive, tangent);
  double turn = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < static_cast<std::size_t>(primitive.kind); ++i) {
    if (on_edge ? primitive.kind != PrimitiveKind::kTriangle || i != here : i == here) continue;
    // From the edge: a component along the edge is perpendicular to both the normal and the tangent.
    const Vec3 into = primitive.vertex[i] - primitive.vertex[on_edge ? (here + 1) % 3 : here];
    const double closing = into.dot(toward);
    if (closing > 0) turn = std::min(turn, std::max(0.0, -into.dot(normal)) / closing);
  }
  return turn;
}

// The minimum over all primitives that share the feature and its plane.
double sharedTurn(const ContactSet& set, const Contact& contact, const SceneAt& scene, const Vec3& tangent) {
  double turn = turnOf(contact, scene, tangent);
  for (const Contact& twin : set.twins) {
    if (samePlane(twin, contact)) turn = std::min(turn, turnOf(twin, scene, tangent));
  }
  return turn;
}

// The length of the curved step divided by `length`, that of the plain step. It is Newton's step if the distance to the
// goal has a minimum in this direction, else as long as possible. It ends at most a little beyond the end of the
// surface, `turn_m` from here, so that the next look finds the next feature.
double stretch(double curvature, double length, double turn_m, double reach, double boldness) {
  using namespace convergence;
  const double most = std::max(1.0, std::min(kLongestPerReach * reach, kTurnedBeyond * turn_m) / length);
  const double newton = curvature > 0 ? std::min(1 / curvature, most) : most;
  return 1 + boldness * (newton - 1);
}

// Curvature term lambda_i / d_i of the obstacle in a curved direction; 1 if the finger lies on the axis or centre of
// curvature.
double curvatureOf(const Contact& contact, double multiplier) { return multiplier / contact.distance; }

// Step on one surface. All its curved tangents have the same curvature, so the Hessian is 1 - lambda / d in them, else
// 1.
Vec3 onSurface(const ContactSet& set, const SceneAt& scene, const Contact& contact, double multiplier,
               const Vec3& plain, double reach, double boldness) {
  const Vec3 part = curvedDirections(contact, scene) * plain;
  const double length = part.norm(), curvature = 1 - curvatureOf(contact, multiplier);
  if (!(length > 0)) return plain;
  const double turn_m = contact.distance * sharedTurn(set, contact, scene, part / length);
  return plain + (stretch(curvature, length, turn_m, reach, boldness) - 1) * part;
}

// Step along the curve in which two surfaces meet. Its curvature term is the sum of theirs along it.
Vec3 onCurve(const ContactSet& set, const SceneAt& scene, const SolverResult& proposal, double reach, double boldness) {
  const auto contact = [&](std::size_t i) -> const Contact& { return set.contacts[proposal.active[i]]; };
  const Vec3& plain = proposal.point;
  Vec3 along = contact(0).plane.normal.cross(contact(1).plane.normal).normalized();
  if (along.dot(plain) < 0) along = -along;
  const double length = along.dot(plain);
  if (!(length > 0)) return plain;
  double bend = 0, turn_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 2; ++i) {
    const double curved = along.dot(curvedDirections(contact(i), scene) * along);
    bend += curvatureOf(contact(i), proposal.multiplier[i]) * curved;
    if (curved > 0) turn_m = std::min(turn_m, contact(i).distance * sharedTurn(set, contact(i), scene, along));
  }
  return plain + (stretch(1 - bend, length, turn_m, reach, boldness) - 1) * length * along;
}

bool staysAbove(const ContactSet& set, const Vec3& step, double tolerance) {
  for (const Plane& plane : set.planes) {
    if (plane.normal.dot(step) < plane.offset - tolerance) return false;
  }
  return true;
}

}  // namespace

std::optional<Vec3> curvatureStep(const ContactSet& set, const SceneAt& scene, const SolverResult& proposal,
                                  const Tolerances& tolerance, double boldness) {
  const double reach = tolerance.reach;
  const Vec3& plain = proposal.point;
  const auto contact = [&](std::size_t i) -> const Contact& { return set.contacts[proposal.active[i]]; };
  const auto curved = [&](std::size_t i) { return contact(i).feature != Feature::kFace; };
  Vec3 step;
  if (proposal.active_count == 1 && curved(0)) {
    step = onSurface(set, scene, contact(0), proposal.multiplier[0], plain, reach, boldness);
  } else if (proposal.active_count == 2 && (curved(0) || curved(1))) {
    step = onCurve(set, scene, proposal, reach, boldness);
  } else {
    return std::nullopt;
  }
  const bool counts = step.allFinite() && (step - plain).norm() > convergence::kWorthwhile * plain.norm() &&
                      staysAbove(set, step, tolerance.feasible);
  return counts ? std::optional(step) : std::nullopt;
}

}  // namespace hl
