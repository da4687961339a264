// Monotone hand-over of late proxies (science, faults 3 and 4), on numbers and on the simulated PHANToM in a hand.
#include "control/hand_over.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

#include "control/servo.h"
#include "device/phantom_arm.h"
#include "device/simulated_device.h"

namespace hl::test_hand_over {
namespace {

constexpr double kK = 1000;

TEST(HandOver, GoesAsFarAsTheEnergyStaysAndNoFarther) {
  std::mt19937 random(4);
  std::normal_distribution<double> m(0, 1e-3);
  const auto vec = [&] { return Vec3(m(random), m(random), m(random)); };
  for (int i = 0; i < 100'000; ++i) {
    HandOverState state;
    state.pulling = true;
    state.end = {vec(), 0.1 + 0.9 * (i % 10) / 9.0};
    const Vec3 finger = vec();
    const SpringEnd wanted{vec(), 0.1 + 0.9 * (i % 7) / 6.0};
    const SpringEnd from = state.end;
    const double before = 0.5 * kK * from.stiffness * (from.proxy_D - finger).squaredNorm();
    handOver(state, LedgerMode::kStrict, kK, wanted, 0, finger, finger);
    const double after = 0.5 * kK * state.end.stiffness * (state.end.proxy_D - finger).squaredNorm();
    ASSERT_LE(after, before + 1e-15);
    const Vec3 way = wanted.proxy_D - from.proxy_D;
    const double part = (state.end.proxy_D - from.proxy_D).dot(way) / way.squaredNorm();
    if (part > 1 - 1e-9) continue;
    // The largest: a little farther would be too far.
    const Vec3 farther = from.proxy_D + std::min(1.0, part + 1e-6) * way;
    ASSERT_GT((farther - finger).norm(), (from.proxy_D - finger).norm() - 1e-15);
  }
}

TEST(HandOver, PaidEnergyAndTheTankLetItThrough) {
  HandOverState state;
  state.pulling = true;
  const SpringEnd wanted{Vec3(0, 0.002, 0), 1};
  handOver(state, LedgerMode::kStrict, kK, wanted, 0.5 * kK * 4e-6, Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(state.end.proxy_D.y(), 0.002, 1e-15);
  EXPECT_NEAR(state.ledger.injected_J, 0, 1e-15);
  state.end = {};
  handOver(state, LedgerMode::kTank, kK, wanted, 0, Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(state.end.proxy_D.y(), 0.002, 1e-15);
  EXPECT_NEAR(state.ledger.by_cause_J[static_cast<std::size_t>(EnergyCause::kLate)], 0.002, 1e-12);
  EXPECT_NEAR(state.ledger.tank_J, kTankStart_J - 0.002, 1e-12);
}

// Largest work of the spring on the device beyond what the steps of a held proxy leak, 1/2 K |step|^2 each (fault 3).
using Excess_J = double;

// A floor whose proxies come once in 33 ms and 33 ms late, in the open too, where they are the finger of then;
// nobody holds the device, which starts above it with a random velocity.
Excess_J lateProxies(LedgerMode mode, unsigned seed) {
  constexpr std::int64_t kPeriod_ns = 1'000'000, kLate = 33;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  SimulatedDeviceSettings coarse;
  coarse.step_s = 50e-6;
  coarse.held = false;
  SimulatedDevice device(coarse);
  ServoSettings settings = ServoSettings::of(device.info());
  settings.stiffness_N_m = 2000 + 1000 * u(random);
  settings.damping_Ns_m = 0;
  settings.ramp_s = 1e-3;
  settings.ledger = mode;
  settings.friction_N = 0;
  auto& arm = dynamic_cast<PhantomArm&>(device.arm());
  arm.setJoints(arm.joints(), 2 * Vec3(u(random), u(random), u(random)));
  ServoState state;
  std::deque<ServoTarget> late;
  Excess_J excess_J = 0;
  double work_J = 0, leak_J = 0;
  Vec3 last = Vec3::Zero(), force = Vec3::Zero();
  for (std::int64_t i = 0; i < 4000; ++i) {
    if (i == 5) hl::arm(state);
    const DeviceSample sample = device.read(i * kPeriod_ns);
    if (i % kLate == 0) {
      const Vec3 proxy(sample.position.x(), std::max(-0.002, sample.position.y()), sample.position.z());
      late.push_back({proxy, 0, true, 1, 0});
    }
    while (late.size() > 2) late.pop_front();
    ServoTarget target = late.front();
    target.time_ns = sample.time_ns;
    if (i > 0) {
      work_J += force.dot(sample.position - last);
      leak_J += 0.5 * settings.stiffness_N_m * (sample.position - last).squaredNorm();
    }
    excess_J = std::max(excess_J, work_J - leak_J);
    last = sample.position;
    force = stepServo(state, settings, target, sample).force_N;
    device.write(force);
  }
  return excess_J;
}

TEST(HandOver, LateProxiesFeedNoEnergyBeyondTheTank) {
  int fed = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Excess_J naive = lateProxies(LedgerMode::kReport, seed);
    fed += naive > 0.1 ? 1 : 0;
    EXPECT_GT(naive, 5e-4) << seed;
    EXPECT_LE(lateProxies(LedgerMode::kStrict, seed), 1e-6) << seed;
    EXPECT_LE(lateProxies(LedgerMode::kTank, seed), kTankStart_J) << seed;
  }
  EXPECT_GE(fed, 10) << "runs in which naive hand-over fed more than 100 mJ";
}

}  // namespace
}  // namespace hl::test_hand_over
