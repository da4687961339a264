// SelfTest: whether a device works as HL takes it to: its tip can be moved to all sides, is quiet at rest, and is
// pulled the way that a force says. A pure machine of servo steps: samples in, forces out, through the servo's own
// states and limits.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "control/servo.h"
#include "device/device.h"

namespace hl {

enum class SelfTestPart {
  kArm,    ///< the servo begins
  kMove,   ///< somebody moves the tip to all sides; no force
  kStill,  ///< somebody holds it still; no force
  kPull,   ///< six pulls, along each axis and back; somebody holds it loosely
  kDone
};

/// One of the six pulls.
struct SelfTestPull {
  Vec3 direction_D = Vec3::Zero();
  double along_m = 0;   ///< how far the tip has gone along the force at its end
  double across_m = 0;  ///< and across it
  double onset_s = -1;  ///< from the first force to motion beyond the noise; < 0: there was none
};

struct SelfTestReport {
  Vec3 range_m = Vec3::Zero();  ///< of the tip while it was moved, each axis
  double noise_m = 0;           ///< largest deviation from the mean while it was held still, each axis on its own
  double pull_N = 0;
  std::array<SelfTestPull, 6> pulls;
  double age_max_s = 0;  ///< of the positions, as the driver knows it
  SafetyState safety = SafetyState::kOff;
  FaultReason fault = FaultReason::kNone;  ///< ended the test
};

class SelfTest {
 public:
  static constexpr double kArm_s = 1, kMove_s = 7, kStill_s = 3, kPull_s = 0.5, kRest_s = 1;  ///< 20 s in all

  SelfTest(const DeviceInfo& info, double period_s);

  /// One servo step: the force for the device. After the end, or a fault, zero. RT-safe.
  Vec3 step(const DeviceSample& sample);
  /// Something found elsewhere ends the test. RT-safe.
  void end(FaultReason reason);

  SelfTestPart part() const { return part_; }
  /// Where a simulated hand should want to be now. RT-safe.
  Vec3 handGoal_D() const;
  const SelfTestReport& report() const { return report_; }

 private:
  void enter(SelfTestPart part);
  void take(const Vec3& position);
  void move(const Vec3& position);
  void still(const Vec3& position);
  void pull(const Vec3& position);

  ServoSettings settings_;
  ServoState servo_;
  SelfTestReport report_;
  SelfTestPart part_ = SelfTestPart::kArm;
  double part_s_ = 0;  // time in this part
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
  Vec3 from_ = Vec3::Zero();  // where a pull began
};

/// What the report says, one line for each thing that is wrong and what to do. Empty: the device has passed.
std::vector<std::string> faultsOf(const SelfTestReport& report);

}  // namespace hl
