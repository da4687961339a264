// The path from encoder to motor on a virtual clock: on time, late, and between the two.
#include "touch/touch_step.h"

#include <gtest/gtest.h>

#include <deque>

#include "device/hand_script.h"
#include "device/simulated_device.h"
#include "guard/realtime_guard.h"
#include "proxy/effect_scenes.h"
#include "touch/loop_chooser.h"

namespace hl::test_touch_step {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr double kRadius_m = 0.002;

ServoSettings undamped(const DeviceInfo& info, double stiffness_N_m) {
  ServoSettings settings = ServoSettings::of(info);
  settings.stiffness_N_m = stiffness_N_m;
  settings.damping_Ns_m = 0;
  settings.ramp_s = settings.period_s;
  settings.friction_N = 0;
  settings.velocity_limit_m_s = 100;  // the fingers of these tests jump
  return settings;
}

ProxyCommands plainCommands() {
  ProxyCommands commands;
  commands.radius_W = kRadius_m;
  return commands;
}

DeviceSample sampleAt(std::int64_t time_ns, const Vec3& position) {
  DeviceSample sample;
  sample.time_ns = time_ns;
  sample.position = position;
  sample.status = DeviceStatus::kOk;
  return sample;
}

class Floor {
 public:
  explicit Floor(Model model = test::floorModel()) : scenes_(test::snapshotOf(std::move(model))), loop_(scenes_, {}) {
    arm(step_.servo());
  }
  // 99 ms in the open: the first scene has been faded in.
  void waitAt(const Vec3& finger, const ServoSettings& settings) {
    for (int i = 1; i < 100; ++i) step_.onTime(loop_, commands_, settings, sampleAt(i * kMs, finger));
  }
  SnapshotSlot scenes_;
  ProxyLoop loop_;
  ProxyCommands commands_ = plainCommands();
  TouchStep step_;
};

// The force answers the sample of its own step: the path is one step long.
TEST(TouchStep, OnTimeTheForceIsThatOfThisVerySample) {
  Floor floor;
  ServoSettings settings = undamped(premium10().info, 1000);
  settings.force_rate_limit_N_s = 1e9;
  floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(kMs, {0, 0.01, 0}));
  for (int i = 2; i < 50; ++i) {
    const double y = kRadius_m + 0.002 * std::sin(0.9 * i);
    const ServoOutput out =
        floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(i * kMs, {1e-4 * i, y, 0}));
    EXPECT_NEAR(out.force_N.y(), 1000 * std::max(0.0, kRadius_m - y), 1e-6) << i;
    EXPECT_NEAR(out.force_N.x(), 0, 1e-9);
  }
}

// On a smooth plane the planes of an old tick say the same as a new one would.
TEST(TouchStep, LateTheFingerStillSlidesOnThePlanesOfTheLastTick) {
  Floor floor;
  const ServoSettings settings = undamped(premium10().info, 1000);
  floor.waitAt({0, 0.01, 0}, settings);
  floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(100 * kMs, {0, 0.001, 0}));
  const HeldContacts held = floor.step_.tick()->held;
  for (int i = 101; i < 140; ++i) {
    const Vec3 finger(0.001 * (i - 100), i % 7 == 0 ? 0.004 : 0.0012, -0.0005 * (i - 100));
    const ServoOutput out = floor.step_.late(held, settings, sampleAt(i * kMs, finger));
    const double expected_N = 1000 * std::max(0.0, kRadius_m - finger.y());
    EXPECT_NEAR(out.force_N.y(), expected_N, 1e-9) << i;
    EXPECT_NEAR(out.force_N.x(), 0, 1e-9);
    EXPECT_EQ(floor.step_.target().time_ns, 100 * kMs) << "how old it is stays known";
  }
}

TEST(TouchStep, LateARoughSurfaceHoldsTheProxyWhereTheTickPutIt) {
  Model rough = test::floorModel();
  rough.materials[0].static_friction = rough.materials[0].dynamic_friction = 0.5;
  Floor floor(rough);
  const ServoSettings settings = undamped(premium10().info, 1000);
  floor.waitAt({0, 0.01, 0}, settings);
  floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(100 * kMs, {0, 0.001, 0}));
  const HeldContacts held = floor.step_.tick()->held;
  EXPECT_TRUE(held.planes_D.empty());
  EXPECT_EQ(held.at({0.01, 0, 0}).proxy_D, held.target.proxy_D);
}

TEST(TouchStep, ASampleThatIsNoReadingTicksNothing) {
  Floor floor;
  const ServoSettings settings = undamped(premium10().info, 1000);
  floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(kMs, {0, 0.01, 0}));
  const Vec3 before = floor.loop_.state().position;
  DeviceSample lost = sampleAt(2 * kMs, {0, -0.05, 0});
  lost.status = DeviceStatus::kLost;
  EXPECT_EQ(floor.step_.onTime(floor.loop_, floor.commands_, settings, lost).force_N, Vec3(Vec3::Zero()));
  EXPECT_EQ(floor.loop_.state().position, before);
  EXPECT_FALSE(floor.step_.tick());
  EXPECT_FALSE(floor.step_.target().valid);
  EXPECT_EQ(floor.step_.target().time_ns, lost.time_ns);
}

TEST(TouchStep, ScenesGoOnWhileTheDeviceIsLost) {
  Floor floor;
  const ServoSettings settings = undamped(premium10().info, 1000);
  DeviceSample lost = sampleAt(0, Vec3::Zero());
  lost.status = DeviceStatus::kLost;
  for (int i = 1; i <= 3; ++i) {
    floor.scenes_.publish(test::snapshotOf(test::floorModel()));
    EXPECT_FALSE(floor.scenes_.taken());
    lost.time_ns = i * kMs;
    floor.step_.onTime(floor.loop_, floor.commands_, settings, lost);
    EXPECT_TRUE(floor.scenes_.taken());
  }
}

// What has changed in scenes that no tick saw may be anything: the hand is taken there as to what is new, though the
// newest of them says that nothing need be blended. A blend goes on as long as the tick says no planes.
TEST(TouchStep, AfterScenesThatWereSkippedTheHandIsTakenOverSlowly) {
  const ServoSettings settings = undamped(premium10().info, 1000);
  DeviceSample lost = sampleAt(0, Vec3::Zero());
  lost.status = DeviceStatus::kLost;
  for (const int scenes : {1, 2}) {
    Floor floor;
    floor.waitAt({0, 0.001, 0}, settings);
    ASSERT_FALSE(floor.step_.tick()->held.planes_D.empty());
    for (int i = 1; i <= scenes; ++i) {
      const auto& last = *floor.scenes_.newest();
      std::vector<Instance> raised = last.instances;
      Pose higher = raised[0].motion.to();
      higher.origin.y() += 0.0005;
      raised[0].motion = Motion(higher);
      floor.scenes_.publish(makeSnapshot(std::move(raised), "next", last.number + 1, 0));
      lost.time_ns = (100 + i) * kMs;
      floor.step_.onTime(floor.loop_, floor.commands_, settings, lost);
    }
    floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(110 * kMs, {0, 0.001, 0}));
    EXPECT_EQ(floor.step_.tick()->held.planes_D.empty(), scenes > 1) << scenes;
  }
}

// A surface of uneven stiffness and shading adds and takes energy all the way, were there a force.
Model uneven() {
  Model model = test::floorModel(Vec3(0.4, 1, 0));
  model.textures = {makeTexture("noise", 16)};
  model.materials[0].smooth = true;
  model.materials[0].textureOf(Quantity::kStiffness) = {0, 0.3, 1};
  return model;
}

TEST(TouchStep, TheLedgerStandsStillWhileTheServoMakesNoForce) {
  Floor floor(uneven());
  const ServoSettings settings = undamped(premium10().info, 1000);
  floor.waitAt({0, 0.01, 0}, settings);
  const auto stroke = [&](int from) {
    for (int i = from; i < from + 200; ++i)
      floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(i * kMs, {1e-4 * (i - from), -0.01, 0}));
    return floor.loop_.state().ledger;
  };
  const Ledger armed = stroke(100);
  EXPECT_GT(armed.injected_J, 1e-3);
  EXPECT_GT(armed.dissipated_J, 1e-3);
  fail(floor.step_.servo(), FaultReason::kTooFast);
  const Ledger late = floor.step_.servo().spring.ledger;
  const Ledger idle = stroke(300);
  EXPECT_EQ(idle.injected_J, armed.injected_J);
  EXPECT_EQ(idle.dissipated_J, armed.dissipated_J);
  EXPECT_EQ(idle.tank_J, armed.tank_J);
  EXPECT_EQ(idle.by_cause_J, armed.by_cause_J);
  EXPECT_EQ(floor.step_.servo().spring.ledger.tank_J, late.tank_J);
  arm(floor.step_.servo());
  EXPECT_GT(stroke(500).dissipated_J, armed.dissipated_J);
}

TEST(TouchStep, AllocatesNothing) {
  Floor floor;
  const ServoSettings settings = undamped(premium10().info, 1000);
  floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(kMs, {0, 0.01, 0}));
  const RealtimeGuard guard;
  for (int i = 2; i < 100; ++i) {
    floor.step_.onTime(floor.loop_, floor.commands_, settings, sampleAt(i * kMs, {0, 0.001, 0}));
    floor.step_.late(floor.step_.tick()->held, settings, sampleAt(i * kMs, {0, 0.001, 0}));
  }
}

TEST(LoopChooser, TicksThatFitStayOnTheServo) {
  LoopChooser place(kMs);
  for (int i = 0; i < 10'000; ++i) place.took(i % 120 == 0 ? 700'000 : 20'000);  // one late in 120
  EXPECT_EQ(place.turn(), Turn::kServo);
}

TEST(LoopChooser, TooManyLateTicksGoToTheProxyLoopAndComeBackWhenTheyFitAgain) {
  LoopChooser place(kMs);
  for (int i = 0; i < 4; ++i) place.took(600'000);
  EXPECT_EQ(place.turn(), Turn::kServo);
  place.took(600'000);
  EXPECT_EQ(place.turn(), Turn::kProxy);
  for (int i = 0; i < 10'000; ++i) place.took(300'000);  // would fit, but not with a margin
  EXPECT_EQ(place.turn(), Turn::kProxy);
  for (int i = 0; i < 499; ++i) place.took(20'000);
  EXPECT_EQ(place.turn(), Turn::kProxy);
  place.took(20'000);
  EXPECT_EQ(place.turn(), Turn::kServo);
}

TEST(LoopChooser, ATurnBeginsWithoutTheDebtsOfTheOneBefore) {
  LoopChooser place(kMs);
  for (int i = 0; i < 4; ++i) place.took(kMs * 6 / 10);
  place.give(Turn::kGroup);
  place.give(Turn::kServo);
  for (int i = 0; i < 4; ++i) place.took(kMs * 6 / 10);
  EXPECT_EQ(place.turn(), Turn::kServo);
  place.took(kMs * 6 / 10);
  EXPECT_EQ(place.turn(), Turn::kProxy) << "five late ones on end";
}

TEST(LoopChooser, OneTickOfManyPeriodsIsEnough) {
  LoopChooser place(kMs);
  place.took(100 * kMs);
  EXPECT_EQ(place.turn(), Turn::kProxy);
}

}  // namespace
}  // namespace hl::test_touch_step
