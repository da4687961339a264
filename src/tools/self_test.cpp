#include "tools/self_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/clock.h"

namespace hl {

namespace {

// Gentle: a loose hand gives way by millimetres, and no device is at its limit.
constexpr double kPullMax_N = 1.5, kPullOfContinuous = 0.5;
constexpr double kMoved_m = 0.02;   // a hand that moves a tip to all sides does more
constexpr double kMotion_m = 3e-4;  // more than encoders and a resting hand make
constexpr double kNoiseMax_m = 2e-3;
constexpr double kSlowOnset_s = 0.1;
constexpr double kOldPosition_s = 0.01;
constexpr std::array<const char*, 3> kAxes{"x (right)", "y (up)", "z (toward you)"};

// The hand's way in the first part: to all sides, within any device's space and at an unhurried speed.
constexpr double kHandReach_m = 0.025;
constexpr std::array<double, 3> kHandTurns_Hz{0.5, 0.8, 0.65};

double lengthOf_s(SelfTestPart part) {
  switch (part) {
    case SelfTestPart::kArm:
      return SelfTest::kArm_s;
    case SelfTestPart::kMove:
      return SelfTest::kMove_s;
    case SelfTestPart::kStill:
      return SelfTest::kStill_s;
    case SelfTestPart::kPull:
      return 6 * (SelfTest::kPull_s + SelfTest::kRest_s);
    case SelfTestPart::kDone:
      break;
  }
  return 0;
}

ServoTarget nothingToPullTo(const DeviceSample& sample) {
  ServoTarget target;
  target.proxy_D = sample.position;
  target.time_ns = sample.time_ns;
  return target;
}

std::string millimetres(double length_m) { return std::to_string(std::lround(1e3 * length_m)) + " mm"; }

std::string faultOf(const SelfTestPull& pull, double noise_m) {
  const double moved_m = std::max(kMotion_m, noise_m);
  Eigen::Index axis = 0;
  pull.direction_D.cwiseAbs().maxCoeff(&axis);
  const std::string where =
      std::string("pull along ") + (pull.direction_D[axis] < 0 ? "-" : "+") + kAxes[static_cast<std::size_t>(axis)];
  if (pull.along_m < -moved_m)
    return where + ": the tip went the other way: sign or axis of the force is wrong; do not use the device";
  if (pull.across_m > std::max(moved_m, 2 * pull.along_m))
    return where + ": the tip went across it by " + millimetres(pull.across_m) +
           ": the axes are exchanged, or the hand moved; test again";
  if (pull.along_m < moved_m)
    return where + ": the tip did not move: hold it loosely; check that the motors have power";
  if (pull.onset_s > kSlowOnset_s)
    return where + ": it began " + std::to_string(std::lround(1e3 * pull.onset_s)) + " ms late; test again";
  return "";
}

}  // namespace

SelfTest::SelfTest(const DeviceInfo& info, double period_s) : settings_(ServoSettings::of(info)) {
  settings_.period_s = period_s;
  report_.pull_N = std::min(kPullMax_N, kPullOfContinuous * info.force_continuous_N);
  for (std::size_t i = 0; i < report_.pulls.size(); ++i)
    report_.pulls[i].direction_D[static_cast<Eigen::Index>(i / 2)] = i % 2 == 0 ? 1 : -1;
  arm(servo_);
}

Vec3 SelfTest::step(const DeviceSample& sample) {
  if (part_ == SelfTestPart::kDone) return Vec3::Zero();
  settings_.effects.constant_N.setZero();
  if (sample.status == DeviceStatus::kOk) take(sample.position);
  report_.age_max_s = std::max(report_.age_max_s, seconds(sample.age_ns));
  const ServoOutput out = stepServo(servo_, settings_, nothingToPullTo(sample), sample);
  report_.safety = out.safety;
  if (out.safety == SafetyState::kFault) end(out.fault);
  part_s_ += settings_.period_s;
  if (part_ != SelfTestPart::kDone && part_s_ >= lengthOf_s(part_))
    enter(static_cast<SelfTestPart>(static_cast<int>(part_) + 1));
  return part_ == SelfTestPart::kDone ? Vec3(Vec3::Zero()) : out.force_N;
}

void SelfTest::end(FaultReason reason) {
  fail(servo_, reason);
  report_.fault = reason;
  report_.safety = SafetyState::kFault;
  part_ = SelfTestPart::kDone;
}

void SelfTest::enter(SelfTestPart part) {
  part_ = part;
  part_s_ = 0;
}

void SelfTest::take(const Vec3& position) {
  if (part_ == SelfTestPart::kMove) move(position);
  if (part_ == SelfTestPart::kStill) still(position);
  if (part_ == SelfTestPart::kPull) pull(position);
}

void SelfTest::move(const Vec3& position) {
  if (part_s_ == 0) low_ = high_ = position;
  low_ = low_.cwiseMin(position);
  high_ = high_.cwiseMax(position);
  report_.range_m = high_ - low_;
}

// The first half is for the hand to come to rest.
void SelfTest::still(const Vec3& position) {
  if (part_s_ < 0.5 * kStill_s) low_ = high_ = position;
  low_ = low_.cwiseMin(position);
  high_ = high_.cwiseMax(position);
  report_.noise_m = 0.5 * (high_ - low_).maxCoeff();
}

void SelfTest::pull(const Vec3& position) {
  const double turn_s = kRest_s + kPull_s;
  const std::size_t number = std::min<std::size_t>(static_cast<std::size_t>(part_s_ / turn_s), 5);
  const double in_turn_s = part_s_ - turn_s * static_cast<double>(number);
  if (in_turn_s < kRest_s) {
    from_ = position;
    return;
  }
  SelfTestPull& pull = report_.pulls[number];
  settings_.effects.constant_N = report_.pull_N * pull.direction_D;
  const Vec3 moved = position - from_;
  pull.along_m = moved.dot(pull.direction_D);
  pull.across_m = (moved - pull.along_m * pull.direction_D).norm();
  if (pull.onset_s < 0 && std::abs(pull.along_m) > std::max(kMotion_m, report_.noise_m))
    pull.onset_s = in_turn_s - kRest_s;
}

Vec3 SelfTest::handGoal_D() const {
  Vec3 goal = Vec3::Zero();
  if (part_ != SelfTestPart::kMove) return goal;
  for (std::size_t axis = 0; axis < 3; ++axis)
    goal[static_cast<Eigen::Index>(axis)] =
        kHandReach_m * std::sin(2 * std::numbers::pi * kHandTurns_Hz[axis] * part_s_);
  return goal;
}

std::vector<std::string> faultsOf(const SelfTestReport& report) {
  if (report.fault != FaultReason::kNone)
    return {std::string("it ended in a fault: ") + faultText(report.fault) + "; end other programs and test again"};
  std::vector<std::string> faults;
  if (report.range_m.maxCoeff() < kMotion_m) return {"the position does not change: the device is not calibrated"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double range_m = report.range_m[static_cast<Eigen::Index>(axis)];
    if (range_m < kMoved_m)
      faults.push_back(std::string("moved by only ") + millimetres(range_m) + " along " + kAxes[axis] +
                       ": move it further; if it was, the device is not calibrated");
  }
  if (report.noise_m > kNoiseMax_m)
    faults.push_back("at rest the position wandered by " + millimetres(report.noise_m) + ": hold it still");
  if (report.age_max_s > kOldPosition_s)
    faults.push_back("positions were up to " + std::to_string(std::lround(1e3 * report.age_max_s)) +
                     " ms old: end other programs, or give this one real-time priority");
  for (const SelfTestPull& pull : report.pulls)
    if (const std::string fault = faultOf(pull, report.noise_m); !fault.empty()) faults.push_back(fault);
  return faults;
}

}  // namespace hl
