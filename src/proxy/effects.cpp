#include "proxy/effects.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/queries.h"

namespace hl {

namespace {

// Neighbours whose shaded normals differ by more meet in a crease: the file means the edge to be seen, and felt.
constexpr double kCrease_rad = 0.01;

// Beyond so many contacts at once the passes are repeated by the tick itself, with the contacts found anew.
constexpr std::size_t kFewContacts = 8;
constexpr int kInnerPasses = 16;

// The way over the edge of a textured triangle that makes its neighbour the one in contact, in proxy radii: the closest
// point of the one left behind is then farther by 1/2 (1e-4)^2 = 5e-9 radii, 50 times the skin.
constexpr double kOverEdge = 1e-4;

constexpr double kSamplesPerTexel = 2;
constexpr int kMostSamples = 4096;

SurfacePlace placeOf(const Contact& contact) { return {contact.primitive, contact.plane.normal, contact.weights}; }

}  // namespace

bool Effects::any(const ContactSet& set) const {
  return std::any_of(set.contacts.begin(), set.contacts.end(), [&](const Contact& contact) {
    const SurfacePlace place = placeOf(contact);
    return reader_.mayBend(contact.primitive) || reader_.dragTextured(contact.primitive) ||
           reader_.value(Quantity::kStaticFriction, place) > 0 ||
           reader_.value(Quantity::kDynamicFriction, place) > 0 || reader_.value(Quantity::kViscosity, place) > 0;
  });
}

// Whether a primitive that shares the edge or vertex under the contact has another normal there.
bool Effects::disagrees(const ContactSet& set, const Contact& contact, const Vec3& normal) const {
  return std::any_of(set.twins.begin(), set.twins.end(), [&](const Contact& twin) {
    if (twin.plane.normal != contact.plane.normal || twin.plane.offset != contact.plane.offset) return false;
    return reader_.bend(placeOf(twin)).normal.cross(normal).norm() > kCrease_rad;
  });
}

// The bent normal of a contact when the proxy has moved on by `offset`.
BentNormal Effects::bend(const ContactSet& set, const Contact& contact, const Vec3& position,
                         const Vec3& offset) const {
  BentNormal plain;
  plain.normal = contact.plane.normal;
  if (!reader_.mayBend(contact.primitive)) return plain;
  SurfacePlace place = placeOf(contact);
  if (!offset.isZero(0)) {
    const ClosestPoint nearest = closestPoint(snapshot_.primitives[contact.primitive], position + offset);
    place.normal = nearest.normal;
    place.weights = nearest.weights;
  }
  const BentNormal bent = reader_.bend(place);
  return bent.bent() && disagrees(set, contact, bent.normal) ? plain : bent;
}

// Pass 1: the sub-goal above the planes as they feel, each bent about the place it holds the proxy off now.
void Effects::firstPass(const ContactSet& set, const Vec3& position, const Vec3& gap, const Vec3& offset,
                        SubGoal& sub_goal) const {
  FixedVector<Plane, kMaxContacts> planes;
  FixedVector<BentNormal, kMaxContacts> bends;
  for (const Contact& contact : set.contacts) {
    const BentNormal bent = bend(set, contact, position, offset);
    const double height = contact.plane.normal.dot(offset) - contact.plane.offset;
    planes.push({bent.normal, bent.normal.dot(offset) - height});
    bends.push(bent);
  }
  sub_goal.solution = nearestAbove({planes.begin(), planes.size()}, gap, tolerance_.feasible);
  sub_goal.normals.clear();
  sub_goal.shading_rad = sub_goal.bump_rad = 0;
  for (std::size_t i = 0; i < sub_goal.solution.active_count; ++i) {
    const BentNormal& bent = bends[sub_goal.solution.active[i]];
    sub_goal.normals.push(bent.normal);
    sub_goal.shading_rad = std::max(sub_goal.shading_rad, bent.shading_rad);
    sub_goal.bump_rad = std::max(sub_goal.bump_rad, bent.bump_rad);
  }
  sub_goal.bent = std::any_of(bends.begin(), bends.end(), [](const BentNormal& b) { return b.bent(); });
  if (sub_goal.solution.violation > tolerance_.feasible) sub_goal.solution.point = offset;
}

// Pass 2: back above the true planes; a goal above all of them comes down to the nearest.
Vec3 Effects::secondPass(const ContactSet& set, const Vec3& goal) const {
  double lowest = std::numeric_limits<double>::infinity();
  Vec3 down = Vec3::Zero();
  for (const Plane& plane : set.planes) {
    const double height = plane.normal.dot(goal) - plane.offset;
    if (height < lowest) {
      lowest = height;
      down = height * plane.normal;
    }
  }
  const Vec3 lowered = lowest > 0 ? Vec3(goal - down) : goal;
  const SolverResult result = nearestAbove({set.planes.begin(), set.planes.size()}, lowered, tolerance_.feasible);
  return result.violation <= tolerance_.feasible ? result.point : Vec3(Vec3::Zero());
}

// What resists a slip from the place that lies `along` the way from here.
Drag Effects::dragAt(const ContactSet& set, const SolverResult& solution, const Vec3& along) const {
  Drag drag;
  for (std::size_t i = 0; i < solution.active_count; ++i) {
    const Contact& contact = set.contacts[solution.active[i]];
    SurfacePlace place = placeOf(contact);
    const bool textured = reader_.dragTextured(contact.primitive);
    if (textured && !along.isZero(0)) place = reader_.moved(place, along);
    const double normal_m = std::max(0.0, solution.multiplier[i]);
    const double dynamic = std::max(0.0, reader_.value(Quantity::kDynamicFriction, place));
    const double fixed = std::max(dynamic, reader_.value(Quantity::kStaticFriction, place));
    const double stribeck = textured ? 0 : reader_.stribeck_m_s(contact.primitive);
    drag.rubs.push({fixed * normal_m, dynamic * normal_m, stribeck * settings_.period_s * settings_.world_per_device});
    drag.viscous +=
        std::max(0.0, reader_.value(Quantity::kViscosity, place)) / (settings_.spring_N_m * settings_.period_s);
  }
  return drag;
}

// Metres along the way until an active textured triangle is left behind; its texture says nothing beyond.
double Effects::lengthWithin(const ContactSet& set, const SolverResult& solution, const Vec3& way) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < solution.active_count; ++i) {
    const Contact& contact = set.contacts[solution.active[i]];
    if (contact.feature != Feature::kFace || !reader_.dragTextured(contact.primitive)) continue;
    const SurfacePlace place = placeOf(contact);
    const SurfacePlace end = reader_.moved(place, way);
    for (std::size_t k = 0; k < 3; ++k) {
      if (end.weights[k] >= 0) continue;
      const double part = place.weights[k] / (place.weights[k] - end.weights[k]);
      least = std::min(least, part * way.norm() + kOverEdge * tolerance_.reach);
    }
  }
  return least;
}

double Effects::texelsAlong(const ContactSet& set, const SolverResult& solution, const Vec3& way) const {
  double most = 0;
  for (std::size_t i = 0; i < solution.active_count; ++i) {
    const Contact& contact = set.contacts[solution.active[i]];
    if (reader_.dragTextured(contact.primitive)) most = std::max(most, reader_.texelsAlong(placeOf(contact), way));
  }
  return most;
}

// The part of the way that friction lets the proxy go, 0..1, after `slipped_now` more than slip_ says.
double Effects::slipFraction(const ContactSet& set, const Vec3& way, double slipped_now, SubGoal& sub_goal) const {
  const SolverResult& solution = sub_goal.solution;
  const double pull = way.norm();
  sub_goal.viscous = 0;
  if (solution.active_count == 0 || !(pull > 0)) return 1;
  const Drag drag = dragAt(set, solution, Vec3::Zero());
  const Slip before{slip_.length + slipped_now, slip_.viscous_m + drag.viscous * slipped_now};
  if (!slipping_ && slipped_now == 0 && pull <= drag.holding() + before.viscous_m) return 0;
  const double texels = texelsAlong(set, solution, way);
  if (texels == 0) {
    sub_goal.viscous = drag.viscous;
    return slipLength(drag, pull, before) / pull;
  }
  const int samples = static_cast<int>(std::clamp(std::ceil(kSamplesPerTexel * texels), 1.0, double{kMostSamples}));
  const auto drag_at = [&](double distance) { return dragAt(set, solution, (distance / pull) * way); };
  const double length = slipLengthAlong(drag_at, pull, before, samples, sub_goal.viscous);
  return std::min(length, lengthWithin(set, solution, way)) / pull;
}

SubGoal Effects::subGoal(const ContactSet& set, const Vec3& position, const Vec3& gap) const {
  const bool textured = std::any_of(set.contacts.begin(), set.contacts.end(),
                                    [&](const Contact& contact) { return reader_.dragTextured(contact.primitive); });
  const bool repeat =
      settings_.shading == ShadingPasses::kConverged && set.contacts.size() <= kFewContacts && !textured;
  SubGoal sub_goal;
  for (int pass = 0; pass < kInnerPasses; ++pass) {
    const Vec3 offset = sub_goal.step;
    firstPass(set, position, gap, offset, sub_goal);
    const Vec3 way = sub_goal.solution.point - offset;
    const Vec3 goal = offset + slipFraction(set, way, offset.norm(), sub_goal) * way;
    sub_goal.step = sub_goal.bent ? secondPass(set, goal) : goal;
    const double change = (sub_goal.step - offset).norm();
    if (!repeat || !sub_goal.bent || change <= kRestPerGap * gap.norm() + tolerance_.rest) break;
  }
  return sub_goal;
}

void Effects::slipped(const SubGoal& sub_goal, double length) {
  if (!(length > 0)) return;
  slip_.length += length;
  slip_.viscous_m += sub_goal.viscous * length;
  slipping_ = true;
}

ProxyContact Effects::describe(const ContactSet& set, const SubGoal& sub_goal, std::size_t i) const {
  const Contact& contact = set.contacts[sub_goal.solution.active[i]];
  const SurfacePlace place = placeOf(contact);
  return {contact.point,
          sub_goal.normals[i],
          sub_goal.solution.multiplier[i],
          contact.primitive,
          std::clamp(reader_.value(Quantity::kStiffness, place), 0.0, 1.0),
          std::max(0.0, reader_.value(Quantity::kStaticFriction, place))};
}

}  // namespace hl
