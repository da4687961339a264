// Servo and simulated device against a wall: at 1800 N/m and 1 kHz the paper's stiffness holds, without damping, as
// long as a hand holds the device. The bare loop: the vibration guard is off.
#include <gtest/gtest.h>

#include "control/servo.h"
#include "device/simulated_device.h"

namespace hl::test_servo_wall {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

struct Touch {
  double swing_m = 0;        ///< of the tip, peak to peak, in the last half second
  double penetration_m = 0;  ///< mean in that time
  double penetration_max_m = 0;
  SafetyState safety = SafetyState::kOff;
};

/// Runs the hand from 20 mm above the floor y = 0 to a goal `depth_m` below it; three seconds of virtual time.
Touch pushOnFloor(bool firm, double stiffness_N_m, double depth_m) {
  SimulatedDeviceSettings device_settings;
  device_settings.firm = firm;
  SimulatedDevice device(device_settings);
  ServoSettings settings = ServoSettings::of(device.info());
  settings.stiffness_N_m = stiffness_N_m;
  settings.damping_Ns_m = 0;
  settings.vibration.on = false;
  ServoState state;
  Touch touch;
  double lowest = 1, highest = -1, sum = 0;
  device.setHandGoal({0, 0.02, 0});
  for (std::int64_t i = 0; i < 4000; ++i) {
    if (i == 200) arm(state);
    if (i == 1000) device.setHandGoal({0.01, -depth_m, 0});
    const DeviceSample sample = device.read(i * kPeriod_ns);
    const Vec3 proxy(sample.position.x(), std::max(0.0, sample.position.y()), sample.position.z());
    const ServoOutput out = stepServo(state, settings, {proxy, sample.time_ns, true}, sample);
    device.write(out.force_N);
    const double y = device.trueTip_D().y();
    touch.penetration_max_m = std::max(touch.penetration_max_m, -y);
    if (i >= 3500) {
      lowest = std::min(lowest, y);
      highest = std::max(highest, y);
      sum -= y;
    }
    touch.safety = out.safety;
  }
  touch.swing_m = highest - lowest;
  touch.penetration_m = sum / 500;
  return touch;
}

class Wall : public testing::TestWithParam<bool> {};

TEST_P(Wall, HandSettlesOnTheFloorAt1800NPerM) {
  for (const double depth_m : {0.005, 0.01, 0.02}) {
    const Touch touch = pushOnFloor(GetParam(), 1800, depth_m);
    EXPECT_EQ(touch.safety, SafetyState::kOn);
    EXPECT_LT(touch.swing_m, 0.15e-3) << depth_m;  // science 4.4: what counts as settled
    EXPECT_GT(touch.penetration_m, 0);
  }
}

TEST_P(Wall, SettledDepthIsWhereTheSpringsBalance) {
  const double k_hand = GetParam() ? 1 / (1 / 800.0 + 1 / 400.0) : 1 / (1 / 300.0 + 1 / 200.0);
  const double depth_m = 0.02;
  const Touch touch = pushOnFloor(GetParam(), 1800, depth_m);
  // Friction at the tip, up to .1 N with two joints, may hold it off by .1 N / (K + k).
  EXPECT_NEAR(touch.penetration_m, depth_m * k_hand / (1800 + k_hand), 0.1 / (1800 + k_hand) + 30e-6);
}

INSTANTIATE_TEST_SUITE_P(Grip, Wall, testing::Bool(),
                         [](const auto& grip) { return std::string(grip.param ? "Firm" : "Light"); });

}  // namespace
}  // namespace hl::test_servo_wall
