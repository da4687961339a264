// Mass: mass, centre of mass and inertia of a rigid body.
#pragma once

#include "base/vec.h"

namespace hl {

/// Object frame. The inertia is about the centre of mass; symmetric and positive definite.
struct Mass {
  double mass_kg = 1;
  Vec3 centre_O = Vec3::Zero();
  Mat3 inertia_kg_m2 = Mat3::Identity();
};

/// Of uniform density, centred at the origin of the object. All arguments > 0.
Mass massOfBall(double mass_kg, double radius_m);
/// `half_m`: half of the sides, each > 0.
Mass massOfBox(double mass_kg, const Vec3& half_m);
/// Along z: a cylinder of this half length, with half a ball at each end.
Mass massOfCapsule(double mass_kg, double half_length_m, double radius_m);

}  // namespace hl
