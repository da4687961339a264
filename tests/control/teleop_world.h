// A teleoperation without threads, sockets and clocks: a person's hand on a device under the real servo step, a line
// that delays, loses and mixes up, and a robot with a wall. It counts the energy of the network by itself.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "control/servo.h"
#include "device/hand.h"

namespace hl::test {

inline constexpr double kTeleopPeriod_s = 1e-3;

/// What the person does.
enum class Person { kTouches, kPushes, kLetsGo, kRests };

struct TeleopSetting {
  GripParameters grip = kFirmGrip;
  Person person = Person::kTouches;
  bool control = true;     ///< false: the force of the robot is a force alone, and its reference goes as commanded
  double delay_s = 0.1;    ///< of each way
  double jitter_s = 0.01;  ///< more than that, evenly
  double loss = 0.05;
  int send_steps = 4;  ///< between two messages
  double scale = 1;    ///< way of the robot by that of the hand
  double force_scale = 1;
  double force_limit_N = 8.5;
  double robot_kg = 1, robot_N_m = 1000, wall_N_m = 5000;  ///< the robot's controller is critically damped
  std::uint32_t seed = 1;
};

/// One way of the line: the newest message counts, as DDS has it of best effort.
class TeleopLine {
 public:
  struct Message {
    double due_s = 0;
    std::int64_t number = 0;
    Vec3 value = Vec3::Zero();
    double total_J = 0;
  };

  void send(const TeleopSetting& setting, std::mt19937& random, double now_s, const Vec3& value, double total_J) {
    std::uniform_real_distribution<double> even(0, 1);
    ++sent_;
    if (even(random) < setting.loss) return;
    way_.push_back({now_s + setting.delay_s + setting.jitter_s * even(random), sent_, value, total_J});
  }
  template <typename Take>
  void receive(double now_s, const Take& take) {
    std::erase_if(way_, [&](const Message& message) {
      if (message.due_s > now_s) return false;
      if (message.number > newest_) take(message);
      newest_ = std::max(newest_, message.number);
      return true;
    });
  }

 private:
  std::vector<Message> way_;
  std::int64_t sent_ = 0, newest_ = 0;
};

/// Frame: y up, the wall's face at y = -10 mm of the hand, at whatever scale.
class TeleopWorld {
 public:
  explicit TeleopWorld(const TeleopSetting& setting) : setting_(setting), random_(setting.seed) {
    settings_.force_limit_N = setting.force_limit_N;
    settings_.force_rate_limit_N_s = 20'000;
    settings_.velocity_limit_m_s = 1e9;
    settings_.ramp_s = kTeleopPeriod_s;
    settings_.remote.on = settings_.remote.engaged = setting.control;
    arm(servo_);
    const Vec3 start = Vec3::Zero();
    robot_ = hlTeleopRobot(start.data(), 1.0);
  }

  void step() {
    stepServoOnce();
    stepRobotReference();
    goal_ = goalOf();
    for (int i = 0; i < kParts; ++i) movePart();
    settleHold();
    ++steps_;
  }

  double time_s() const { return kTeleopPeriod_s * static_cast<double>(steps_); }
  /// What hand and robot have put into the network less what it has given them, J at the robot, by true ways.
  double network_J() const { return (setting_.scale / setting_.force_scale) * hand_J_ + robot_J_; }
  /// What it may ever give: the tanks of both sides.
  double tanks_J() const { return HL_TELEOP_TANK_J * (1 + setting_.scale / setting_.force_scale); }
  const Vec3& tip() const { return tip_; }
  const Vec3& tipVelocity_m_s() const { return tip_velocity_; }
  const Vec3& robotPlace() const { return place_; }
  const Vec3& contact_N() const { return contact_N_; }
  const Vec3& felt_N() const { return servo_.force_N; }
  const ServoState& servo() const { return servo_; }
  const HLteleopRobot& robot() const { return robot_; }

 private:
  static constexpr int kParts = 4;
  static constexpr double kPart_s = kTeleopPeriod_s / kParts;
  static constexpr double kDevice_kg = 0.075, kDeviceFriction_N = 0.038, kCount_m = 32e-6, kWall_m = 0.010;

  bool holds() const { return setting_.person != Person::kLetsGo || std::fmod(time_s(), 6) < 1.5; }

  Vec3 goalOf() const {
    const double t = std::fmod(time_s(), 6);
    if (setting_.person == Person::kRests) return {0, time_s() < 1.5 ? -0.03 : 0, 0};
    if (setting_.person == Person::kPushes) return {0, -0.04, 0};
    return {0.01 * std::sin(time_s()), t < 3 ? -0.03 : 0.02, 0};
  }

  void stepServoOnce() {
    DeviceSample sample;
    sample.status = DeviceStatus::kOk;
    sample.time_ns = (steps_ + 1) * 1'000'000;
    for (int i = 0; i < 3; ++i) sample.position[i] = kCount_m * std::round(tip_[i] / kCount_m);
    to_hand_.receive(time_s(), [&](const TeleopLine::Message& message) {
      const Vec3 force_N = limited(setting_.force_scale * message.value, setting_.force_limit_N);
      settings_.remote.force_N = force_N;
      settings_.remote.fresh_until_ns = sample.time_ns + 25'000'000;
      const double total_J = message.total_J * setting_.force_scale / setting_.scale;
      settings_.remote.given_up_J = std::max(settings_.remote.given_up_J, total_J);
      if (!setting_.control) settings_.effects.constant_N = force_N;
    });
    ServoTarget nothing;
    nothing.time_ns = sample.time_ns;
    stepServo(servo_, settings_, nothing, sample);
    if (steps_ % setting_.send_steps != 0) return;
    const double total_J = servo_.remote.energy.sent_J * setting_.scale / setting_.force_scale;
    to_robot_.send(setting_, random_, time_s(), setting_.scale * sample.position, total_J);
  }

  void stepRobotReference() {
    to_robot_.receive(time_s(), [&](const TeleopLine::Message& message) {
      hlTeleopSetPoint(&robot_, message.value.data(), steps_ == 0);
      hlTeleopReceive(&robot_.port, message.total_J);
    });
    if (!setting_.control) robot_.port.tank_J = 1e9;
    const Vec3 way(robot_.way_m);
    robot_J_ += 0.5 * (contact_N_ + contact_before_N_).dot(way);
    contact_before_N_ = contact_N_;
    hlTeleopStep(&robot_, contact_N_.data(), kTeleopPeriod_s);
    if (steps_ % setting_.send_steps == 0) to_hand_.send(setting_, random_, time_s(), contact_N_, robot_.port.sent_J);
  }

  // Semi-implicit Euler.
  void movePart() {
    stepWish(hand_, goal_, kPart_s);
    const Vec3 pad_N = held_ ? padForce(setting_.grip, hand_, tip_, tip_velocity_) : Vec3(Vec3::Zero());
    stepHand(setting_.grip, hand_, pad_N, kPart_s);
    const Vec3 free_N = pad_N + servo_.force_N - stops_N();
    tip_velocity_ += kPart_s / kDevice_kg * free_N;
    tip_velocity_ -= limited(tip_velocity_, kPart_s / kDevice_kg * kDeviceFriction_N);
    tip_ += kPart_s * tip_velocity_;
    hand_J_ -= servo_.force_N.dot(kPart_s * tip_velocity_);

    const double depth = -kWall_m * setting_.scale - place_.y();
    contact_N_ = Vec3(0, depth > 0 ? std::max(0.0, setting_.wall_N_m * depth - 5 * speed_.y()) : 0, 0);
    const double damping_Ns_m = 2 * std::sqrt(setting_.robot_N_m * setting_.robot_kg);
    const Vec3 led_N = setting_.robot_N_m * (Vec3(robot_.reference_m) - place_) +
                       damping_Ns_m * (Vec3(robot_.way_m) / kTeleopPeriod_s - speed_);
    speed_ += kPart_s / setting_.robot_kg * (limited(led_N, 100) + contact_N_);
    place_ += kPart_s * speed_;
  }

  // The ends of the workspace.
  Vec3 stops_N() const { return 2000 * (tip_ - tip_.cwiseMax(Vec3::Constant(-0.1)).cwiseMin(Vec3::Constant(0.1))); }

  // A hand that takes hold again does so where the device is.
  void settleHold() {
    if (holds() && !held_) {
      hand_.position = hand_.wish = tip_;
      hand_.velocity = hand_.wish_velocity = tip_velocity_;
    }
    held_ = holds();
  }

  const TeleopSetting setting_;
  std::mt19937 random_;
  ServoSettings settings_;
  ServoState servo_;
  TeleopLine to_robot_, to_hand_;
  HLteleopRobot robot_;
  HandState hand_;
  Vec3 goal_ = Vec3::Zero(), tip_ = Vec3::Zero(), tip_velocity_ = Vec3::Zero();
  Vec3 place_ = Vec3::Zero(), speed_ = Vec3::Zero();
  Vec3 contact_N_ = Vec3::Zero(), contact_before_N_ = Vec3::Zero();
  double hand_J_ = 0, robot_J_ = 0;
  bool held_ = true;
  std::int64_t steps_ = 0;
};

}  // namespace hl::test
