// R6, R7: a device that nobody holds and a finger that stops dead, against a free body, through the servo step; beside
// two masses on a spring that only presses, moved as the equations say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bodies/test_worlds.h"
#include "plain_servo.h"
#include "touch/touch_step.h"

namespace hl::test_free_device {
namespace {

constexpr double kRadius_m = 0.001, kHalf_m = 0.02;
constexpr double kStiffness_N_m = 1000, kBody_kg = 0.1;

// A cube at rest without gravity, whose face toward -x is at x = kRadius_m: a finger touches it from x = 0 on.
std::shared_ptr<const Snapshot> cubeBefore(double mass_kg) {
  Instance instance = test::instanceOf(test::boxModel(Vec3::Constant(kHalf_m)), 1);
  BodySpec spec;
  spec.mass_kg = mass_kg;
  spec.shape = BodyShape::kBox;
  const Pose start{Mat3::Identity(), {kRadius_m + kHalf_m, 0, 0}};
  instance.body = makeRigidBody("cube", spec, start, instance.shape->bounds, {Vec3::Constant(-10), Vec3::Constant(10)});
  instance.driver = instance.body->poses;
  return makeSnapshot({instance}, {}, 1, 0, {Vec3::Zero(), {}});
}

ServoSettings servoOf(double period_s) {
  ServoSettings settings = test::plainServo(kStiffness_N_m, period_s);
  settings.vibration.on = false;
  return settings;
}

// A finger that moves along x, and the cube.
class Line {
 public:
  explicit Line(double period_s) : settings_(servoOf(period_s)), scenes_(cubeBefore(kBody_kg)), loop_(scenes_, {}) {
    commands_.radius_W = kRadius_m;
    arm(step_.servo());
    for (int i = 0; i < 10; ++i) step(-0.01);  // until the servo makes force
  }

  // The force along x on the hand of a finger that is there at the begin of the step.
  double step(double finger_m) {
    DeviceSample sample;
    sample.time_ns = time_ns_ += std::llround(1e9 * settings_.period_s);
    sample.position = {finger_m, 0, 0};
    sample.status = DeviceStatus::kOk;
    return step_.onTime(loop_, commands_, settings_, sample).force_N.x();
  }
  double velocity_m_s() const { return scenes_.bodies()->state().bodies[0].velocity.x(); }
  double owed_N_s() const { return scenes_.bodies()->owed_N_s().x(); }
  double way_m() const { return scenes_.bodies()->state().bodies[0].centre.x() - kRadius_m - kHalf_m; }

 private:
  ServoSettings settings_;
  SnapshotSlot scenes_;
  ProxyLoop loop_;
  ProxyCommands commands_;
  TouchStep step_;
  std::int64_t time_ns_ = 0;
};

// The same as two numbers: the force of the end of the step, where it presses.
class TwoPoints {
 public:
  explicit TwoPoints(double period_s) : period_s_(period_s) {}

  double step(double finger_m) {
    const double T = period_s_, pressed_m = finger_m - way_m_ - T * velocity_m_s_;
    const double force_N = -std::max(0.0, kStiffness_N_m * pressed_m / (1 + kStiffness_N_m * T * T / kBody_kg));
    velocity_m_s_ -= T * force_N / kBody_kg;
    way_m_ += T * velocity_m_s_;
    return force_N;
  }
  double velocity_m_s() const { return velocity_m_s_; }
  double way_m() const { return way_m_; }
  static double owed_N_s() { return 0; }

 private:
  double period_s_, velocity_m_s_ = 0, way_m_ = 0;
};

constexpr double kDevice_kg = 0.075, kSpeed_m_s = 0.2;

struct After {
  double device_m_s = 0, body_m_s = 0, imbalance_N_s = 0;

  double energyRatio() const {
    return (kDevice_kg * device_m_s * device_m_s + kBody_kg * body_m_s * body_m_s) /
           (kDevice_kg * kSpeed_m_s * kSpeed_m_s);
  }
};

// A device without friction flies against the cube; its force is held for a step. `start_m`: in front of the cube.
template <typename Bench>
After hit(double period_s, double start_m) {
  Bench bench(period_s);
  double finger_m = -start_m;
  After after{kSpeed_m_s, 0, 0};
  for (double t = 0; t < 0.1; t += period_s) {
    const double acceleration = bench.step(finger_m) / kDevice_kg;
    finger_m += period_s * after.device_m_s + period_s * period_s / 2 * acceleration;
    after.device_m_s += period_s * acceleration;
    after.body_m_s = bench.velocity_m_s();
    const double momentum = kDevice_kg * after.device_m_s + kBody_kg * after.body_m_s + bench.owed_N_s();
    after.imbalance_N_s = std::max(after.imbalance_N_s, std::abs(momentum - kDevice_kg * kSpeed_m_s));
  }
  return after;
}

// To the first order in T the swing between the two decays by K T (rho - 1/2) / (2 m_d) per second, and lasts half a
// period: kinetic energy of the one against the other is lost, that of both together is not.
double ratioOfTheory(double period_s) {
  const double rho = kDevice_kg / kBody_kg, of_both = rho / (1 + rho);
  const double w = std::sqrt(kStiffness_N_m * (1 / kDevice_kg + 1 / kBody_kg));
  const double decay = kStiffness_N_m * period_s * (rho - 0.5) / (2 * kDevice_kg);
  return of_both + (1 - of_both) * std::exp(-2 * decay * M_PI / w);
}

TEST(FreeDevice, R6HitsABodyAsTwoPointsDo) {
  for (const double period_s : {1e-3, 0.25e-3}) {
    for (const double start_m : {0.0001, 0.00013, 0.00016, 0.00019}) {
      const After found = hit<Line>(period_s, start_m), expected = hit<TwoPoints>(period_s, start_m);
      EXPECT_LT(found.imbalance_N_s, 1e-12);
      EXPECT_NEAR(found.device_m_s, expected.device_m_s, 1e-7) << period_s << " " << start_m;
      EXPECT_NEAR(found.body_m_s, expected.body_m_s, 1e-7) << period_s << " " << start_m;
    }
  }
}

// With T = 0 the device goes back with 0.028571 m/s and the body away with 0.171429 m/s.
TEST(FreeDevice, R6LosesTheEnergyThatTheoryGives) {
  // In which part of a step the two meet decides on up to a third of a percent.
  for (const double start_m : {0.0001, 0.00013, 0.00016, 0.00019}) {
    const After coarse = hit<Line>(1e-3, start_m), fine = hit<Line>(0.25e-3, start_m);
    EXPECT_NEAR(coarse.energyRatio(), ratioOfTheory(1e-3), 0.003);
    EXPECT_NEAR(fine.energyRatio(), ratioOfTheory(0.25e-3), 0.0005);
    EXPECT_NEAR(fine.device_m_s, -0.028571, 0.001);
    EXPECT_NEAR(fine.body_m_s, 0.171429, 0.001);
  }
}

constexpr double kAcceleration_m_s2 = 5;

// The finger presses so that the cube gets kAcceleration_m_s2 in each step, until it has 1 m/s; then it stops dead. The
// velocity at which the cube leaves.
template <typename Bench>
double release(double period_s) {
  Bench bench(period_s);
  const double stretch_m = kBody_kg * kAcceleration_m_s2 / kStiffness_N_m;
  double finger_m = 0, end_m_s = 0;
  while (end_m_s < 1 - 1e-9) {
    end_m_s += period_s * kAcceleration_m_s2;
    finger_m = bench.way_m() + period_s * (bench.velocity_m_s() + period_s * kAcceleration_m_s2) + stretch_m;
    bench.step(finger_m);
  }
  for (double t = 0; t < 0.1; t += period_s) bench.step(finger_m);
  return bench.velocity_m_s();
}

// Where the spring is relaxed within a step, it gives the cube nothing more; with T = 0 it gives all that it holds.
TEST(FreeDevice, R7TheCubeTakesWhatTheSpringHoldsWhenTheFingerStops) {
  const double all_m_s = std::sqrt(1 + kBody_kg * kAcceleration_m_s2 * kAcceleration_m_s2 / kStiffness_N_m);
  EXPECT_NEAR(all_m_s, 1.00125, 1e-5);
  const double stretch_m = kBody_kg * kAcceleration_m_s2 / kStiffness_N_m;
  for (const double period_s : {1e-3, 0.25e-3, 0.125e-3, 0.05e-3}) {
    const double found = release<Line>(period_s);
    EXPECT_NEAR(found, release<TwoPoints>(period_s), 1e-7);
    EXPECT_NEAR(found, all_m_s, 0.005 * all_m_s);
    // The force of the end of a step is that much behind on the way of the spring.
    const double theory = all_m_s - kStiffness_N_m * period_s * stretch_m / (2 * kBody_kg);
    EXPECT_NEAR(found, std::max(1.0, theory), 1e-5) << period_s;
  }
}

}  // namespace
}  // namespace hl::test_free_device
