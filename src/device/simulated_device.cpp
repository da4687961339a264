#include "device/simulated_device.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// With the links folded no further than their stops the tip reaches from 94 to 367 mm; the box of the workspace around
// this point spans 95 to 366 mm.
const Vec3 kOrigin_P(0.19, 0, 0);

Vec3 toDevice(const Vec3& v_P) { return {v_P.y(), v_P.z(), v_P.x()}; }
Vec3 toPhantom(const Vec3& v_D) { return {v_D.z(), v_D.x(), v_D.y()}; }

DeviceInfo makeInfo(const PhantomParameters& arm) {
  DeviceInfo info;
  info.name = "simulated PHANToM Premium 1.5";
  info.workspace_min = Vec3(-0.1905, -0.1335, -0.0955);  // 381 x 267 x 191 mm
  info.workspace_max = -info.workspace_min;
  info.force_max_N = arm.motor_torque_peak_Nm * arm.gear.y() / arm.l2;
  info.force_continuous_N = 1.4;
  info.friction_N = 0.04;  // the vendor's figure; the joints' .01 Nm make .047 to .059 N
  info.stiffness_N_m = 1000;
  info.stiffness_max_N_m = 3500;
  info.damping_Ns_m = 0.5;
  info.resolution_m = 30e-6;
  info.velocity_max_m_s = 3;
  // What the stiffest spring asks for under the fastest hand: touch never changes a force faster.
  info.force_rate_max_N_s = info.stiffness_max_N_m * info.velocity_max_m_s;
  info.servo_rate_Hz = 1000;
  return info;
}

}  // namespace

SimulatedDevice::SimulatedDevice(const SimulatedDeviceSettings& settings)
    : settings_(settings), info_(makeInfo(settings.arm)), origin_P_(kOrigin_P) {
  phantomJoints(settings.arm, origin_P_, q_);
  firm_ = settings.firm;
}

void SimulatedDevice::setJoints(const Vec3& q, const Vec3& qdot) {
  q_ = q;
  qdot_ = qdot;
  friction_impulse_ = Vec3::Zero();
  hand_ = HandState{};
  hand_.position = hand_.wish = goal_D_ = trueTip_D();
  goal_.write(goal_D_);
}

Vec3 SimulatedDevice::trueTip_D() const { return toDevice(phantomTip(settings_.arm, q_) - origin_P_); }

// The encoders count whole steps, rounded down; kinematics then works on what they say.
Vec3 SimulatedDevice::countedJoints() const {
  Vec3 counted;
  for (int i = 0; i < 3; ++i) {
    const double step = 2 * M_PI / (settings_.arm.encoder_counts * settings_.arm.gear[i]);
    counted[i] = std::floor(q_[i] / step) * step;
  }
  return counted;
}

DeviceSample SimulatedDevice::read(std::int64_t now_ns) {
  Vec3 goal;
  if (goal_.read(goal) && goal.allFinite()) goal_D_ = goal;
  if (has_time_) {
    const double elapsed_s =
        std::clamp(1e-9 * static_cast<double>(now_ns - time_ns_), 0.0, settings_.longest_advance_s);
    const int steps = static_cast<int>(std::ceil(elapsed_s / settings_.step_s));
    for (int i = 0; i < steps; ++i) step(elapsed_s / steps);
  }
  has_time_ = true;
  time_ns_ = now_ns;
  return {now_ns, toDevice(phantomTip(settings_.arm, countedJoints()) - origin_P_), 0, DeviceStatus::kOk};
}

// Torques J' f in DAC counts, within what the motors can give; held until the next write.
void SimulatedDevice::write(const Vec3& force_N) {
  const PhantomParameters& arm = settings_.arm;
  Vec3 wanted = Vec3::Zero();
  if (force_N.allFinite()) wanted = phantomJacobian(arm, countedJoints()).transpose() * toPhantom(force_N);
  for (int i = 0; i < 3; ++i) {
    const double peak = arm.motor_torque_peak_Nm * arm.gear[i];
    const double count = 2 * peak / std::pow(2.0, arm.dac_bits);
    torque_[i] = std::round(std::clamp(wanted[i], -peak, peak - count) / count) * count;
  }
}

// Semi-implicit Euler; Coulomb friction implicitly, so that it stops a joint and never drives one.
void SimulatedDevice::step(double dt_s) {
  const PhantomParameters& arm = settings_.arm;
  const Mat3 jacobian = phantomJacobian(arm, q_);
  Vec3 torque = torque_ - phantomCoriolis(arm, q_, qdot_) - arm.joint_damping_Nms * qdot_;
  if (settings_.held) {
    const GripParameters& grip = firm_.load(std::memory_order_relaxed) ? kFirmGrip : kLightGrip;
    const Vec3 pad = padForce(grip, hand_, trueTip_D(), toDevice(jacobian * qdot_));
    stepWish(hand_, goal_D_, dt_s);
    stepHand(grip, hand_, pad, dt_s);
    torque += jacobian.transpose() * toPhantom(pad);
  }
  torque += phantomStops(arm, q_, qdot_);
  const Mat3 mass = phantomMass(arm, q_);
  const Vec3 free_qdot = qdot_ + dt_s * mass.inverse() * torque;
  qdot_ = phantomFriction(arm, mass, free_qdot, dt_s, friction_impulse_);
  q_ += dt_s * qdot_;
}

Vec3 SimulatedDevice::motorForce() const {
  return toDevice(phantomJacobian(settings_.arm, q_).transpose().inverse() * torque_);
}

double SimulatedDevice::energy_J() const {
  double energy = 0.5 * qdot_.dot(phantomMass(settings_.arm, q_) * qdot_) + phantomStopEnergy_J(settings_.arm, q_);
  if (settings_.held) {
    const GripParameters& grip = firm_.load() ? kFirmGrip : kLightGrip;
    energy += 0.5 * grip.hand_mass_kg * hand_.velocity.squaredNorm() +
              0.5 * grip.pad_stiffness_N_m * (hand_.position - trueTip_D()).squaredNorm() +
              0.5 * grip.arm_stiffness_N_m * (hand_.wish - hand_.position).squaredNorm();
  }
  return energy;
}

}  // namespace hl
