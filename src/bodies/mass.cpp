#include "bodies/mass.h"

namespace hl {

Mass massOfBall(double mass_kg, double radius_m) {
  Mass mass;
  mass.mass_kg = mass_kg;
  mass.inertia_kg_m2 = 0.4 * mass_kg * radius_m * radius_m * Mat3::Identity();
  return mass;
}

Mass massOfBox(double mass_kg, const Vec3& half_m) {
  const Vec3 square = half_m.cwiseProduct(half_m);
  Mass mass;
  mass.mass_kg = mass_kg;
  mass.inertia_kg_m2 = (mass_kg / 3 * (Vec3::Constant(square.sum()) - square)).asDiagonal();
  return mass;
}

// The half balls: inertia 2/5 m r^2 about the flat face's centre, whose distance from their own centre is 3/8 r.
Mass massOfCapsule(double mass_kg, double half_length_m, double radius_m) {
  const double length = 2 * half_length_m, r = radius_m;
  const double cylinder_part = length / (length + 4.0 / 3 * r);  // of the volume
  const double cylinder = cylinder_part * mass_kg, balls = mass_kg - cylinder;
  const double along = cylinder * r * r / 2 + balls * 2.0 / 5 * r * r;
  const double across = cylinder * (length * length / 12 + r * r / 4) +
                        balls * (2.0 / 5 * r * r + length * length / 4 + 3.0 / 8 * length * r);
  Mass mass;
  mass.mass_kg = mass_kg;
  mass.inertia_kg_m2 = Vec3(across, across, along).asDiagonal();
  return mass;
}

}  // namespace hl
