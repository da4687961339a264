#include "device/simulated_device.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"

namespace hl {

SimulatedDevice::SimulatedDevice(const SimulatedDeviceSettings& settings)
    : settings_(settings),
      arm_(makeArm(settings.model, settings.current_lag_s)),
      wrist_(settings.model.wrist),
      random_(settings.seed) {
  settings_.delay_steps = std::clamp(settings.delay_steps, 0, SimulatedDeviceSettings::kMaxDelay);
  on_the_way_.fill(Vec3::Zero());
  orders_.firm = settings.firm;
  orders_.holds = held_ = settings.held;
}

void SimulatedDevice::place(const Vec3& tip_D, const Vec3& velocity_m_s) {
  arm_->place(tip_D, velocity_m_s);
  stylus_ = arm_->tip_D();
  stylus_velocity_ = arm_->velocity_D();
  takeHold();
  orders_.goal_D.write(goal_D_);
}

void SimulatedDevice::takeHold() {
  hand_.position = hand_.wish = goal_D_ = trueTip_D();
  hand_.velocity = hand_.wish_velocity = trueVelocity_D();
}

double SimulatedDevice::jitter_ns() {
  return settings_.jitter_s > 0 ? 1e9 * settings_.jitter_s * random_() / (1.0 + std::mt19937::max()) : 0;
}

DeviceSample SimulatedDevice::read(std::int64_t now_ns) {
  const bool holds = orders_.holds.load();
  if (holds && !held_) takeHold();
  held_ = holds;
  Vec3 goal;
  if (orders_.goal_D.read(goal) && goal.allFinite()) goal_D_ = goal;
  if (stopped_.exchange(false, std::memory_order_acquire)) dropForce();
  const std::int64_t taken_ns = now_ns + static_cast<std::int64_t>(jitter_ns());
  if (time_ns_) {
    const double elapsed_s = std::clamp(seconds(taken_ns - *time_ns_), 0.0, settings_.longest_advance_s);
    const int steps = static_cast<int>(std::ceil(elapsed_s / settings_.step_s));
    for (int i = 0; i < steps; ++i) step(elapsed_s / steps);
    turnWrist(elapsed_s);
  }
  time_ns_ = taken_ns;
  DeviceSample sample{now_ns, arm_->countedTip_D(), orders_.buttons, DeviceStatus::kOk, held_};
  sample.stylus = wrist_.counted();
  return sample;
}

// What nobody holds stays as it is.
void SimulatedDevice::turnWrist(double dt_s) {
  Eigen::Quaterniond goal_D;
  if (orders_.turn_D.read(goal_D)) wrist_.turnTo(goal_D);
  wrist_.openTo(orders_.gripper_rad);
  if (held_) wrist_.step(dt_s);
}

void SimulatedDevice::dropForce() {
  std::fill(on_the_way_.begin(), on_the_way_.end(), Vec3(Vec3::Zero()));
  arm_->drive(Vec3::Zero());
}

void SimulatedDevice::write(const Vec3& force_N) {
  const std::size_t room = on_the_way_.size();
  on_the_way_[written_ % room] = force_N.allFinite() ? force_N : Vec3(Vec3::Zero());
  const std::size_t arrives = written_ + room - static_cast<std::size_t>(settings_.delay_steps);
  arm_->drive(on_the_way_[arrives % room]);
  ++written_;
}

void SimulatedDevice::step(double dt_s) {
  Vec3 pull_N = settings_.load_N;
  if (held_) pull_N += stepHeld(dt_s);
  if (settings_.bends) pull_N = stepStylus(pull_N, dt_s);
  arm_->step(pull_N, dt_s);
}

// The force of the hand on what it holds.
Vec3 SimulatedDevice::stepHeld(double dt_s) {
  const Vec3 pad_N = padForce(grip(), hand_, trueTip_D(), trueVelocity_D());
  stepWish(hand_, goal_D_, dt_s);
  stepHand(grip(), hand_, pad_N, dt_s);
  return pad_N;
}

// The force on the arm of a stylus that is pulled.
Vec3 SimulatedDevice::stepStylus(const Vec3& pull_N, double dt_s) {
  const Bending& b = settings_.bending;
  const double damping_Ns_m = 2 * b.damping_ratio * std::sqrt(b.stiffness_N_m * b.stylus_kg);
  const Vec3 bend_N =
      b.stiffness_N_m * (stylus_ - arm_->tip_D()) + damping_Ns_m * (stylus_velocity_ - arm_->velocity_D());
  stylus_velocity_ += dt_s / b.stylus_kg * (pull_N - bend_N);
  stylus_ += dt_s * stylus_velocity_;
  return bend_N;
}

double SimulatedDevice::energy_J() const {
  double energy = arm_->energy_J();
  if (held_) {
    energy += 0.5 * grip().hand_mass_kg * hand_.velocity.squaredNorm() +
              0.5 * grip().pad_stiffness_N_m * (hand_.position - trueTip_D()).squaredNorm() +
              0.5 * grip().arm_stiffness_N_m * (hand_.wish - hand_.position).squaredNorm();
  }
  if (settings_.bends) {
    energy += 0.5 * settings_.bending.stylus_kg * stylus_velocity_.squaredNorm() +
              0.5 * settings_.bending.stiffness_N_m * (stylus_ - arm_->tip_D()).squaredNorm();
  }
  return energy;
}

}  // namespace hl
