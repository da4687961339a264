#include "device/mass_arm.h"

#include <algorithm>

namespace hl {

Vec3 MassArm::countedTip_D() const {
  const double step = parameters_.resolution_m;
  return step > 0 ? Vec3((tip_ / step).array().floor() * step) : tip_;
}

void MassArm::drive(const Vec3& force_N) {
  const double peak = parameters_.force_peak_N;
  const double count = parameters_.dac_bits > 0 ? 2 * peak / std::pow(2.0, parameters_.dac_bits) : 0;
  for (int i = 0; i < 3; ++i) {
    commanded_[i] = std::clamp(force_N[i], -peak, peak - count);
    if (count > 0) commanded_[i] = std::round(commanded_[i] / count) * count;
  }
  force_ = currentAfter(force_, commanded_, 0);
}

Vec3 MassArm::beyondStops() const { return tip_ - tip_.cwiseMax(parameters_.low_D).cwiseMin(parameters_.high_D); }

void MassArm::step(const Vec3& pull_N, double dt_s) {
  const MassParameters& p = parameters_;
  force_ = currentAfter(force_, commanded_, dt_s);
  Vec3 all_N = force_ + pull_N - p.damping_Ns_m * velocity_;
  const Vec3 beyond = beyondStops();
  for (int i = 0; i < 3; ++i) {
    if (beyond[i] != 0) all_N[i] -= p.stop_stiffness_N_m * beyond[i] + p.stop_damping_Ns_m * velocity_[i];
  }
  const Vec3 free_velocity = velocity_ + dt_s / p.mass_kg * all_N;
  const double speed = free_velocity.norm();
  velocity_ =
      speed > 0 ? Vec3(free_velocity * std::max(0.0, 1 - p.friction_N * dt_s / (p.mass_kg * speed))) : free_velocity;
  tip_ += dt_s * velocity_;
}

double MassArm::energy_J() const {
  return 0.5 * parameters_.mass_kg * velocity_.squaredNorm() +
         0.5 * parameters_.stop_stiffness_N_m * beyondStops().squaredNorm();
}

void MassArm::place(const Vec3& tip_D, const Vec3& velocity_m_s) {
  tip_ = tip_D;
  velocity_ = velocity_m_s;
}

}  // namespace hl
