// MassArm: a device of which little is published, as one mass that its motors push along the axes of D. It has viscous
// damping, Coulomb friction against the motion, encoders of equal steps along each axis, and a box of end stops. What a
// real linkage does beside that, inertia that changes with direction and place, it does not do.
#pragma once

#include "device/arm.h"

namespace hl {

struct MassParameters {
  double mass_kg = 0.072;
  double damping_Ns_m = 0;
  double friction_N = 0;                                ///< Coulomb, whatever the direction
  double resolution_m = 0;                              ///< one encoder step; 0: no steps
  double force_peak_N = 10;                             ///< of the motors along each axis
  int dac_bits = 16;                                    ///< 0: no rounding
  Vec3 low_D{-0.1, -0.1, -0.1}, high_D{0.1, 0.1, 0.1};  ///< m, the end stops
  double stop_stiffness_N_m = 5000, stop_damping_Ns_m = 5;
};

class MassArm final : public Arm {
 public:
  MassArm(const MassParameters& parameters, double current_lag_s) : Arm(current_lag_s), parameters_(parameters) {}

  Vec3 tip_D() const override { return tip_; }
  Vec3 velocity_D() const override { return velocity_; }
  Vec3 countedTip_D() const override;
  void drive(const Vec3& force_N) override;
  Vec3 motorForce_N() const override { return force_; }
  void step(const Vec3& pull_N, double dt_s) override;
  double energy_J() const override;
  void place(const Vec3& tip_D, const Vec3& velocity_m_s) override;

 private:
  Vec3 beyondStops() const;

  MassParameters parameters_;
  Vec3 tip_ = Vec3::Zero();
  Vec3 velocity_ = Vec3::Zero();
  Vec3 commanded_ = Vec3::Zero();  // N, what the DAC says
  Vec3 force_ = Vec3::Zero();      // N, what the current makes
};

}  // namespace hl
