// Free motion: how a body moves for one step with the velocity that the contacts have left it.
#pragma once

#include "bodies/world.h"

namespace hl {

/// Of a rigid body: the directions about which it turns steadily.
struct PrincipalAxes {
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();  ///< from these axes to the object frame
  Vec3 moments_kg_m2 = Vec3::Ones();                         ///< ascending
};
PrincipalAxes principalAxesOf(const Mass& mass);

/// Moves the centre by `way`, and turns the body freely for `period_s` (> 0) from its present spin: the angular
/// momentum stays the same to rounding. The turn of a body with two equal moments is exact, whatever its spin; the
/// energy of another one oscillates with the square of the step, and does not drift. RT-safe.
void moveFreely(const PrincipalAxes& body, BodyState& state, const Vec3& way, double period_s);

/// The rotation by |turn| rad about its direction, the same bits on every machine; of very large turns a part. RT-safe.
Eigen::Quaterniond rotationBy(const Vec3& turn_rad);

}  // namespace hl
