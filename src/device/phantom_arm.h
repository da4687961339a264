// PhantomArm: the joint-space model of phantom.h in motion, with its encoders and motors. D's x = P's y (right),
// y = P's z (up), z = P's x (toward the user).
#pragma once

#include "device/arm.h"
#include "device/phantom.h"

namespace hl {

/// The origin of D, (0.19, 0, 0) m in P, is where the workspace box of 381 x 267 x 191 mm just fits between the arm's
/// nearest and farthest reach; the tip starts there.
class PhantomArm final : public Arm {
 public:
  PhantomArm(const PhantomParameters& parameters, double current_lag_s);

  Vec3 tip_D() const override;
  Vec3 velocity_D() const override;
  Vec3 countedTip_D() const override;
  void drive(const Vec3& force_N) override;
  Vec3 motorForce_N() const override;
  void step(const Vec3& pull_N, double dt_s) override;
  double energy_J() const override;
  void place(const Vec3& tip_D, const Vec3& velocity_m_s) override;

  Vec3 joints() const { return q_; }
  Vec3 motorTorque_Nm() const { return torque_; }  ///< at the joints
  void setJoints(const Vec3& q, const Vec3& qdot);

 private:
  Vec3 countedJoints() const;

  PhantomParameters parameters_;
  Vec3 q_ = Vec3::Zero();
  Vec3 qdot_ = Vec3::Zero();
  Vec3 commanded_ = Vec3::Zero();  // N m at the joints, what the DAC says
  Vec3 torque_ = Vec3::Zero();     // N m, what the current makes
  Vec3 friction_impulse_ = Vec3::Zero();
};

}  // namespace hl
