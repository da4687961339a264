// A teleoperation over a line of 100 ms each way that loses a twentieth: ten minutes of every grip, and random lines.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "control/teleop_world.h"

namespace hl::test_teleoperation {
namespace {

using test::Person;
using test::TeleopSetting;
using test::TeleopWorld;

constexpr GripParameters kNormalGrip{500, 1.4, 0.12, 3.5, 300};
constexpr std::array<GripParameters, 3> kGrips{kLightGrip, kNormalGrip, kFirmGrip};
constexpr std::array<Person, 4> kPersons{Person::kTouches, Person::kPushes, Person::kLetsGo, Person::kRests};

struct Seen {
  double least_J = 0;    // of what the network has been given less what it has given
  double reach_m = 0;    // of the device
  double last_m_s = 0;   // fastest in the last second
  double touched_N = 0;  // most, of robot and wall
  double felt_N = 0;     // most
};

Seen run(const TeleopSetting& setting, int steps) {
  TeleopWorld world(setting);
  Seen seen;
  for (int i = 0; i < steps; ++i) {
    world.step();
    seen.least_J = std::min(seen.least_J, world.network_J());
    seen.reach_m = std::max(seen.reach_m, world.tip().norm());
    seen.touched_N = std::max(seen.touched_N, world.contact_N().norm());
    seen.felt_N = std::max(seen.felt_N, world.felt_N().norm());
    if (i >= steps - 1000) seen.last_m_s = std::max(seen.last_m_s, world.tipVelocity_m_s().norm());
  }
  return seen;
}

TEST(Teleoperation, GivesNoMoreThanItsTanksForTenMinutesInEveryGrip) {
  for (const GripParameters& grip : kGrips) {
    for (const Person person : kPersons) {
      TeleopSetting setting;
      setting.grip = grip;
      setting.person = person;
      const Seen seen = run(setting, 600'000);
      EXPECT_GE(seen.least_J, -TeleopWorld(setting).tanks_J());
      EXPECT_LT(seen.reach_m, 0.06);  // hands go to 45 mm by themselves
      EXPECT_GT(seen.touched_N, 2);
      EXPECT_GT(seen.felt_N, 2);
    }
  }
}

TEST(Teleoperation, ComesToRestWithTheHand) {
  for (const GripParameters& grip : kGrips) {
    for (const Person person : {Person::kPushes, Person::kRests}) {
      TeleopSetting setting;
      setting.grip = grip;
      setting.person = person;
      EXPECT_LT(run(setting, 20'000).last_m_s, 1e-3);
    }
  }
}

// What the same line does to a plain force.
TEST(Teleoperation, WithoutTheControlItGivesMoreAndMore) {
  for (const GripParameters& grip : kGrips) {
    for (const Person person : {Person::kTouches, Person::kPushes}) {
      TeleopSetting setting;
      setting.grip = grip;
      setting.person = person;
      setting.control = false;
      const double first_J = run(setting, 15'000).least_J;
      const Seen seen = run(setting, 33'000);  // at whose end the hand is at the wall
      EXPECT_LT(first_J, -1);
      EXPECT_LT(seen.least_J, 1.5 * first_J);
      EXPECT_GT(seen.last_m_s, 0.2);
    }
  }
}

RC_GTEST_PROP(TeleoperationOnAnyLine, GivesNoMoreThanItsTanks, ()) {
  const auto between = [](double least, double most) {
    return least + (most - least) * 1e-3 * *rc::gen::inRange(0, 1001);
  };
  TeleopSetting setting;
  setting.grip = *rc::gen::elementOf(kGrips);
  setting.person = *rc::gen::elementOf(kPersons);
  setting.delay_s = between(0, 0.4);
  setting.jitter_s = between(0, 0.05);
  setting.loss = between(0, 0.5);
  setting.send_steps = *rc::gen::inRange(1, 10);
  setting.scale = between(0.25, 4);
  setting.force_scale = between(0.25, 1);
  setting.robot_N_m = between(300, 1500);
  setting.robot_kg = between(0.5, 1.5);
  setting.wall_N_m = between(500, 10'000);
  setting.seed = *rc::gen::arbitrary<std::uint32_t>();
  const Seen seen = run(setting, 10'000);
  RC_ASSERT(seen.least_J >= -TeleopWorld(setting).tanks_J());
}

}  // namespace
}  // namespace hl::test_teleoperation
