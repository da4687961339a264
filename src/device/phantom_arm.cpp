#include "device/phantom_arm.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// With the links folded no further than their stops the tip reaches from 94 to 367 mm; the box of the workspace around
// this point spans 95 to 366 mm.
const Vec3 kOrigin_P(0.19, 0, 0);

Vec3 phantomToDevice(const Vec3& v_P) { return {v_P.y(), v_P.z(), v_P.x()}; }
Vec3 toPhantom(const Vec3& v_D) { return {v_D.z(), v_D.x(), v_D.y()}; }

}  // namespace

PhantomArm::PhantomArm(const PhantomParameters& parameters, double current_lag_s)
    : Arm(current_lag_s), parameters_(parameters) {
  place(Vec3::Zero(), Vec3::Zero());
}

void PhantomArm::setJoints(const Vec3& q, const Vec3& qdot) {
  q_ = q;
  qdot_ = qdot;
  friction_impulse_ = Vec3::Zero();
}

void PhantomArm::place(const Vec3& tip_D, const Vec3& velocity_m_s) {
  Vec3 q;
  if (!phantomJoints(parameters_, toPhantom(tip_D) + kOrigin_P, q)) return;
  setJoints(q, phantomJacobian(parameters_, q).inverse() * toPhantom(velocity_m_s));
}

Vec3 PhantomArm::tip_D() const { return phantomToDevice(phantomTip(parameters_, q_) - kOrigin_P); }

Vec3 PhantomArm::velocity_D() const { return phantomToDevice(phantomJacobian(parameters_, q_) * qdot_); }

// The encoders count whole steps, rounded down; kinematics then works on what they say.
Vec3 PhantomArm::countedJoints() const {
  Vec3 counted;
  for (int i = 0; i < 3; ++i) {
    const double step = 2 * M_PI / (parameters_.encoder_counts * parameters_.gear[i]);
    counted[i] = std::floor(q_[i] / step) * step;
  }
  return counted;
}

Vec3 PhantomArm::countedTip_D() const { return phantomToDevice(phantomTip(parameters_, countedJoints()) - kOrigin_P); }

// Torques J' f in DAC counts, within what the motors can give.
void PhantomArm::drive(const Vec3& force_N) {
  const Vec3 wanted = phantomJacobian(parameters_, countedJoints()).transpose() * toPhantom(force_N);
  for (int i = 0; i < 3; ++i) {
    const double peak = parameters_.motor_torque_peak_Nm * parameters_.gear[i];
    const double count = 2 * peak / std::pow(2.0, parameters_.dac_bits);
    commanded_[i] = std::round(std::clamp(wanted[i], -peak, peak - count) / count) * count;
  }
  torque_ = currentAfter(torque_, commanded_, 0);
}

Vec3 PhantomArm::motorForce_N() const {
  return phantomToDevice(phantomJacobian(parameters_, q_).transpose().inverse() * torque_);
}

void PhantomArm::step(const Vec3& pull_N, double dt_s) {
  const PhantomParameters& p = parameters_;
  torque_ = currentAfter(torque_, commanded_, dt_s);
  Vec3 torque = torque_ - phantomCoriolis(p, q_, qdot_) - p.joint_damping_Nms * qdot_;
  torque += phantomJacobian(p, q_).transpose() * toPhantom(pull_N);
  torque += phantomStops(p, q_, qdot_);
  const Mat3 mass = phantomMass(p, q_);
  const Vec3 free_qdot = qdot_ + dt_s * mass.inverse() * torque;
  qdot_ = phantomFriction(p, mass, free_qdot, dt_s, friction_impulse_);
  q_ += dt_s * qdot_;
}

double PhantomArm::energy_J() const {
  return 0.5 * qdot_.dot(phantomMass(parameters_, q_) * qdot_) + phantomStopEnergy_J(parameters_, q_);
}

}  // namespace hl
