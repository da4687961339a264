// Snaps and fields of bodies: the hand holds a body by its snap, or is drawn by its field, and what it gets, it gives.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies/test_worlds.h"
#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "plain_servo.h"
#include "touch/touch_step.h"

namespace hl::test_body_snaps {
namespace {

constexpr double kRadius_m = 0.001;
constexpr std::int64_t kMs = 1'000'000;
constexpr double kHalf_m = 0.01;

SnapSpec snapOf(std::vector<Vec3> points, double capture_m, double release_N) {
  return {"handle", std::move(points), {}, capture_m, release_N};
}

// A block about the origin, with snaps, that nothing else holds; a device's finger.
class Held {
 public:
  Held(double mass_kg, const SnapSpec& snap, double gravity_m_s2, const FieldList& fields = {}) {
    Instance instance = test::instanceOf(test::boxModel(Vec3::Constant(kHalf_m)), 1);
    instance.snaps = std::make_shared<const SnapList>(SnapList{snap});
    instance.fields = std::make_shared<const FieldList>(fields);
    BodySpec spec;
    spec.mass_kg = mass_kg;
    spec.shape = BodyShape::kBox;
    setBody(instance,
            makeRigidBody("block", spec, {}, instance.shape->bounds, {Vec3::Constant(-10), Vec3::Constant(10)}));
    scenes_.emplace(makeSnapshot({instance}, {}, 1, 0, {Vec3(0, -gravity_m_s2, 0), {}}));
    loop_.emplace(*scenes_, ProxySettings{});
    arm(step_.servo());
    commands_.radius_W = kRadius_m;
  }

  Vec3 step(const Vec3& finger, const ServoSettings& settings) {
    DeviceSample sample;
    sample.time_ns = time_ns_ += kMs;
    sample.position = finger;
    sample.status = DeviceStatus::kOk;
    const Vec3 force = step_.onTime(*loop_, commands_, settings, sample).force_N;
    given_ += settings.period_s * force;
    return force;
  }
  const BodyState& body() const { return scenes_->bodies()->state().bodies[0]; }
  const BodyWorld& world() const { return *scenes_->bodies(); }
  const ProxyState& proxy() const { return loop_->state(); }
  const ProxyStep& tick() const { return *step_.tick(); }
  Vec3 imbalance() const {
    return given_ + world().world().bodies[0].mass.mass_kg * body().velocity + world().owed_N_s();
  }

 private:
  std::optional<SnapshotSlot> scenes_;
  std::optional<ProxyLoop> loop_;
  TouchStep step_;
  ProxyCommands commands_;
  std::int64_t time_ns_ = 0;
  Vec3 given_ = Vec3::Zero();
};

// A point in front of the block, a line along it, and a finger that pulls it about.
TEST(BodySnaps, ActionIsReactionToRounding) {
  test::Random random(1);
  for (const SnapSpec& snap :
       {snapOf({{0.015, 0, 0}}, 2e-3, 50), snapOf({{0.015, -0.02, 0}, {0.015, 0.02, 0}}, 2e-3, 50)}) {
    Held held(0.1, snap, 0);
    const ServoSettings settings = test::plainServo(1000);
    Vec3 finger(0.018, 0, 0), velocity = Vec3::Zero();
    for (; !held.proxy().snap.holds(); finger.x() -= 5e-5) held.step(finger, settings);
    int holds = 0;
    for (int i = 0; i < 5000; ++i) {
      velocity = 0.99 * velocity + 0.01 * random.inCube(0.5);
      finger += 1e-3 * velocity;
      held.step(finger, settings);
      ASSERT_LT(held.imbalance().norm(), 1e-12) << i;
      holds += held.proxy().snap.holds() ? 1 : 0;
    }
    EXPECT_EQ(holds, 5000);
    EXPECT_GT(held.body().velocity.norm(), 1e-3);
  }
}

TEST(BodySnaps, ABlockHangsOnTheFingerAndFallsWhenItIsShaken) {
  Held held(0.05, snapOf({{0, 0.015, 0}}, 2e-3, 3), 9.81);
  const ServoSettings settings = test::plainServo(1000);
  Vec3 finger(0, 0.015, 0), force = Vec3::Zero();
  for (int i = 0; i < 4000; ++i) {
    finger.y() += 2e-5;
    force = held.step(finger, settings);
  }
  EXPECT_NEAR(force.y(), -0.05 * 9.81, 0.01);
  EXPECT_NEAR(held.body().centre.y(), finger.y() - 0.015, 1e-3);
  for (int i = 0; i < 10; ++i) held.step(finger += Vec3(0, 2e-3, 0), settings);
  EXPECT_FALSE(held.proxy().snap.holds());
  for (int i = 0; i < 100; ++i) force = held.step(finger, settings);
  EXPECT_EQ(force.norm(), 0);
  EXPECT_LT(held.body().velocity.y(), 0);
}

// A body of any mass at a free finger of 75 g: their oscillation about each other does not grow.
TEST(BodySnaps, ABodyOfAnyMassIsHeldStill) {
  for (const double mass_kg : {1e-5, 1e-3, 0.01, 0.1, 10.0}) {
    for (const SnapSpec& snap :
         {snapOf({Vec3(0.02, 0, 0)}, 5e-3, 50), snapOf({{0.02, -1, 0}, {0.02, 1, 0}}, 5e-3, 50)}) {
      Held held(mass_kg, snap, 0);
      const ServoSettings settings = test::plainServo(1000);
      constexpr double kFinger_kg = 0.075, kDamping_Ns_m = 1e-3;
      Vec3 finger(0.02, 0, 0), velocity(0.05, 0, 0);
      double most_m_s = 0;
      for (int i = 0; i < 3000; ++i) {
        const Vec3 force = held.step(finger, settings);
        velocity += 1e-3 / kFinger_kg * (force - kDamping_Ns_m * velocity);
        finger += 1e-3 * velocity;
        most_m_s = std::max(most_m_s, velocity.norm());
        ASSERT_TRUE(held.proxy().snap.holds()) << mass_kg << ", " << i;
      }
      EXPECT_LE(most_m_s, 0.05 * (1 + 1e-3)) << mass_kg;
    }
  }
}

FieldSpec fieldOf(FieldKind kind, const Vec3& point, double reach_m, double force_N) {
  FieldSpec field;
  field.kind = kind;
  field.points = {point};
  field.reach_m = reach_m;
  field.force_N = force_N;
  return field;
}

// A magnet in front of a block, and one that pushes aside: what the hand gets, the block gives.
TEST(BodyFields, ActionIsReactionToRounding) {
  test::Random random(3);
  FieldList fields{fieldOf(FieldKind::kMagnet, {0.02, 0, 0}, 0.03, 2),
                   fieldOf(FieldKind::kConstant, {0.02, 0, 0}, 0.02, 0.5)};
  fields[1].direction = Vec3::UnitY();
  Held held(0.1, snapOf({{5, 0, 0}}, 1e-3, 1), 0, fields);
  const ServoSettings settings = test::plainServo(1000);
  Vec3 finger(0.06, 0, 0), velocity = Vec3::Zero();
  double most_N = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 to_block = held.body().centre + Vec3(0.03, 0, 0) - finger;
    velocity = 0.99 * velocity + 0.02 * to_block + 0.01 * random.inCube(0.3);
    finger += 1e-3 * velocity;
    most_N = std::max(most_N, held.step(finger, settings).norm());
    ASSERT_LT(held.imbalance().norm(), 1e-12) << i;
  }
  EXPECT_GT(most_N, 1);
  EXPECT_GT(held.body().velocity.norm(), 1e-3);
}

// A block that swings and turns about a hand that does not move, at a magnet of 27 N/m: its energy does not grow.
TEST(BodyFields, ABlockSwingsAboutAStillHandWithTheEnergyThatItHas) {
  constexpr double kReach_m = 0.05, kForce_N = 0.2;
  const Vec3 magnet(0.03, 0, 0), hand(0.035, 0, 0);
  for (const double mass_kg : {1e-3, 0.01, 0.1}) {
    Held held(mass_kg, snapOf({{5, 0, 0}}, 1e-3, 1), 0, {fieldOf(FieldKind::kMagnet, magnet, kReach_m, kForce_N)});
    const ServoSettings settings = test::plainServo(1000);
    const auto energy_J = [&] {
      const World& world = held.world().world();
      const double u = (poseOf(world.bodies[0], held.body()).toWorld(magnet) - hand).norm() / kReach_m;
      const double potential_J = kForce_N * kReach_m * 6.75 * (u * u / 2 - 2 * u * u * u / 3 + u * u * u * u / 4);
      return kineticEnergy_J(world, held.world().state()) + potential_J;
    };
    held.step(hand, settings);
    const double begin_J = energy_J();
    double most_J = 0;
    for (int i = 0; i < 20'000; ++i) {
      held.step(hand, settings);
      most_J = std::max(most_J, energy_J());
    }
    EXPECT_LE(most_J, 1.1 * begin_J) << mass_kg;
    EXPECT_GT(held.body().velocity.norm() + held.body().spin.norm(), 1e-3) << mass_kg;
  }
}

TEST(BodySnaps, TheStepReportsWhichSnapHolds) {
  Held held(0.1, snapOf({{0.015, 0, 0}}, 2e-3, 50), 0);
  const ServoSettings settings = test::plainServo(1000);
  held.step({0.05, 0, 0}, settings);
  EXPECT_EQ(held.tick().snap.object.key, 0U);
  held.step({0.016, 0, 0}, settings);
  EXPECT_EQ(held.tick().snap.object.key, 1U);
  EXPECT_EQ(held.tick().snap.number, 0U);
  EXPECT_TRUE(held.tick().held.planes_D.empty());
  EXPECT_NEAR(held.tick().held.held_N.x(), -1, 1e-6);
}

TEST(BodySnaps, AStepTakesNoMemory) {
  test::Random random(2);
  Held held(0.1, snapOf({{0.015, 0, 0}}, 5e-3, 50), 0);
  const ServoSettings settings = test::plainServo(1000);
  held.step({0.016, 0, 0}, settings);
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) held.step(Vec3(0.015, 0, 0) + random.inCube(2e-3), settings);
  EXPECT_TRUE(held.proxy().snap.holds());
}

}  // namespace
}  // namespace hl::test_body_snaps
