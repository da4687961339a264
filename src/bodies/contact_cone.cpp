#include "bodies/contact_cone.h"

#include <algorithm>

namespace hl {

namespace {

// Of the step of a row: where it hardly slips, the impulse across the slip is no stiffer.
constexpr double kStiffest = 1e6;

// All that the normal impulse takes with it.
Vec3 pullOf(const Row& row, const ConePlace& place) { return row.normal + row.friction * place.slip; }

}  // namespace

ConePlace placeInCone(const Row& row, const Vec3& impulse, const Vec3& velocity, double demand) {
  ConePlace place;
  const double along = row.normal.dot(velocity), pressed_now = row.normal.dot(impulse);
  const double pressed = pressed_now + row.normal_step * (demand - along);
  if (!(pressed > 0)) return place;
  const Vec3 dragged = impulse - pressed_now * row.normal - row.drag_step * (velocity - along * row.normal);
  const double most = row.friction * pressed, drag = dragged.norm();
  place.impulse = pressed * row.normal + dragged;
  place.state = ConePlace::State::kSticks;
  if (drag <= most) return place;
  place.state = ConePlace::State::kSlips;
  place.slip = dragged / drag;
  place.impulse = pressed * row.normal + most * place.slip;
  place.across_kg = row.drag_step * std::min(kStiffest, most / (drag - most));
  return place;
}

// Across the slip the impulse x is to be k (x1 + s m), with k = most / drag and the velocity m that is missed there: so
// x1 = s k / (1 - k) m.
Vec3 impulseAskedFor(const Row& row, const ConePlace& place, const Vec3& impulse, const Vec3& missed,
                     double weight_kg) {
  if (place.state == ConePlace::State::kApart) return Vec3::Zero();
  if (place.state == ConePlace::State::kSticks) return impulse + weight_kg * missed;
  const Vec3 across = row.normal.cross(place.slip);
  const double pressed = row.normal.dot(impulse) + weight_kg * row.normal.dot(missed);
  return pressed * pullOf(row, place) + place.across_kg * across.dot(missed) * across;
}

Mat3 impulsePerVelocity(const Row& row, const ConePlace& place, double weight_kg) {
  if (place.state == ConePlace::State::kApart) return Mat3::Zero();
  if (place.state == ConePlace::State::kSticks) return weight_kg * Mat3::Identity();
  const Vec3 across = row.normal.cross(place.slip);
  return weight_kg * pullOf(row, place) * row.normal.transpose() + place.across_kg * across * across.transpose();
}

}  // namespace hl
