#include "device/wrist.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hl {

namespace {

// Of the spring of the hand: a wrist turns by a right angle in about 0.3 s. Guessed, as its arm's bandwidth.
constexpr double kHand_rad_s = 2 * std::numbers::pi * 3;
constexpr double kLongestStep_s = 1e-3;

double counted(double angle, double resolution) {
  return resolution > 0 ? std::round(angle / resolution) * resolution : angle;
}

// Angles of a gimbal: yaw about y, then pitch about x, then roll about z. At a pitch of 90 degrees the yaw has it all.
Eigen::Quaterniond countedTurn(const Eigen::Quaterniond& turned, double resolution_rad) {
  const Mat3 r = turned.toRotationMatrix();
  const double pitch = std::asin(std::clamp(-r(1, 2), -1.0, 1.0));
  const bool is_locked = std::hypot(r(0, 2), r(2, 2)) < 1e-9;
  const double yaw = is_locked ? std::atan2(-r(2, 0), r(0, 0)) : std::atan2(r(0, 2), r(2, 2));
  const double roll = is_locked ? 0 : std::atan2(r(1, 0), r(1, 1));
  const auto about = [&](double angle, const Vec3& axis) {
    return Eigen::AngleAxisd(counted(angle, resolution_rad), axis);
  };
  return about(yaw, Vec3::UnitY()) * about(pitch, Vec3::UnitX()) * about(roll, Vec3::UnitZ());
}

}  // namespace

Eigen::Quaterniond Wrist::atRest() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(-35 * std::numbers::pi / 180, Vec3::UnitX()));
}

Wrist::Wrist(const WristParameters& parameters)
    : parameters_(parameters),
      goal_(parameters.resolution_rad > 0 ? atRest() : Eigen::Quaterniond::Identity()),
      turned_(goal_) {}

void Wrist::turnTo(const Eigen::Quaterniond& goal_D) {
  Eigen::Quaterniond goal = goal_D;
  if (parameters_.resolution_rad > 0 && toUnit(goal)) goal_ = goal;
}

void Wrist::openTo(double goal_rad) {
  if (std::isfinite(goal_rad)) gripper_goal_rad_ = std::clamp(goal_rad, 0.0, parameters_.gripper_max_rad);
}

void Wrist::step(double dt_s) {
  if (!(parameters_.resolution_rad > 0) && !(parameters_.gripper_max_rad > 0)) return;
  const int steps = std::clamp(static_cast<int>(std::ceil(dt_s / kLongestStep_s)), 1, 1000);
  for (int i = 0; i < steps; ++i) stepOnce(dt_s / steps);
}

// x'' = w^2 (goal - x) - 2 w x', implicit in the speed.
void Wrist::stepOnce(double dt_s) {
  const double spring = dt_s * kHand_rad_s * kHand_rad_s, drag = 1 + 2 * dt_s * kHand_rad_s;
  spin_rad_s_ = (spin_rad_s_ + spring * rotationVector(goal_ * turned_.conjugate())) / drag;
  const double angle = dt_s * spin_rad_s_.norm();
  if (angle > 0) {
    turned_ = Eigen::AngleAxisd(angle, spin_rad_s_.normalized()) * turned_;
    turned_.normalize();
  }
  gripper_rad_s_ = (gripper_rad_s_ + spring * (gripper_goal_rad_ - gripper_rad_)) / drag;
  gripper_rad_ = std::clamp(gripper_rad_ + dt_s * gripper_rad_s_, 0.0, parameters_.gripper_max_rad);
}

Stylus Wrist::counted() const {
  Stylus stylus;
  if (parameters_.resolution_rad > 0) stylus.turned = countedTurn(turned_, parameters_.resolution_rad);
  stylus.gripper_rad =
      std::min(hl::counted(gripper_rad_, parameters_.gripper_resolution_rad), parameters_.gripper_max_rad);
  return stylus;
}

}  // namespace hl
