#include "control/effects.h"

namespace hl {

namespace {

constexpr double kGravity_m_s2 = 9.80665;  // standard gravity

}  // namespace

Vec3 effectForce(const Effects& effects, const DeviceSample& sample, const Vec3& velocity_m_s, bool touching) {
  Vec3 force_N = sample.weight_N + effects.constant_N;
  force_N.y() += effects.tool_mass_kg * kGravity_m_s2;
  force_N += effects.spring_N_m * (effects.spring_D - sample.position);
  if (!touching) force_N -= effects.free_damping_Ns_m * velocity_m_s;
  return force_N;
}

}  // namespace hl
