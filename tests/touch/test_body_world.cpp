// Bodies within the servo step: what a device feels of them, and they of it.
#include "touch/body_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "block_scenes.h"
#include "guard/realtime_guard.h"
#include "plain_servo.h"
#include "touch/touch_step.h"

namespace hl::test_body_world {
namespace {

constexpr double kRadius_m = 0.001;
constexpr std::int64_t kMs = 1'000'000;

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Blocks, and a floor that they stand on; a device's finger among them.
class Bench {
 public:
  using Block = test::Block;

  Bench(const std::vector<Block>& blocks, double friction, double gravity = 9.81) {
    scenes_.emplace(test::sceneOfBlocks(blocks, friction, gravity));
    loop_.emplace(*scenes_, ProxySettings{});
    arm(step_.servo());
    commands_.radius_W = kRadius_m;
  }

  /// The next scene: others of these blocks than those of before begin there.
  void show(const std::vector<Block>& blocks, double friction, double gravity = 9.81) {
    scenes_->publish(test::sceneOfBlocks(blocks, friction, gravity, 2));
  }
  void setSurfaces(const MaterialOverride& surfaces) { commands_.surfaces = surfaces; }
  // The force on the hand; the finger is there at the begin of the step.
  Vec3 step(const Vec3& finger, const ServoSettings& settings) {
    DeviceSample sample;
    sample.time_ns = time_ns_ += kMs;
    sample.position = finger;
    sample.status = DeviceStatus::kOk;
    force_ = step_.onTime(*loop_, commands_, settings, sample).force_N;
    given_ += settings.period_s * force_;
    return force_;
  }
  void act(const BodyCommands& commands) { loop_->act(commands); }
  void give(const Vec3& velocity, const Vec3& spin) { scenes_->bodies()->set(0, velocity, spin); }
  const BodyState& body(std::size_t i = 0) const { return world().state().bodies[i]; }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < world().world().bodies.size(); ++i)
      sum += world().world().bodies[i].mass.mass_kg * body(i).velocity;
    return sum;
  }
  // N s: on the hand, on the bodies, and owed to them.
  Vec3 imbalance() const { return given_ + momentum() + world().owed_N_s(); }
  const Vec3& proxy() const { return loop_->state().position; }
  const BodyWorld& world() const { return *scenes_->bodies(); }

 private:
  std::optional<SnapshotSlot> scenes_;
  std::optional<ProxyLoop> loop_;
  TouchStep step_;
  ProxyCommands commands_;
  std::int64_t time_ns_ = 0;
  Vec3 force_ = Vec3::Zero(), given_ = Vec3::Zero();
};

// Moves the finger from `from` at this velocity; returns the last force.
Vec3 sweep(Bench& bench, const ServoSettings& settings, Vec3& finger, const Vec3& velocity, double seconds) {
  Vec3 force = Vec3::Zero();
  for (double t = 0; t < seconds; t += settings.period_s) {
    finger += settings.period_s * velocity;
    force = bench.step(finger, settings);
  }
  return force;
}

TEST(BodyWorld, R1TheHandFeelsTheFrictionOfTheBlockThatItPushes) {
  Bench bench({{}}, 0.4);
  const ServoSettings settings = test::plainServo(1000);
  Vec3 finger(-0.03, 0.02, 0);
  sweep(bench, settings, finger, Vec3::Zero(), 0.1);
  const Vec3 force = sweep(bench, settings, finger, Vec3(0.01, 0, 0), 5);
  EXPECT_NEAR(force.x(), -0.3924, 1e-5);
  EXPECT_LT(std::abs(force.y()) + std::abs(force.z()), 1e-5);
  EXPECT_NEAR(bench.body().centre.x(), finger.x() + 0.0003924 + kRadius_m + 0.02, 0.001);
}

TEST(BodyWorld, ActionIsReactionToRounding) {
  Bench bench({{0.1, Vec3(0.02, 0.02, 0.02), Vec3(0, 0.05, 0)}, {0.03, Vec3(0.01, 0.02, 0.01), Vec3(0.05, 0.05, 0)}}, 0,
              0);
  const ServoSettings settings = test::plainServo(1000);
  std::mt19937_64 random(7);
  Vec3 finger(-0.04, 0.05, 0), velocity = Vec3::Zero();
  for (int i = 0; i < 5000; ++i) {
    velocity = 0.99 * velocity +
               0.01 * Vec3(between(random, -0.5, 0.7), between(random, -0.2, 0.2), between(random, -0.2, 0.2));
    finger += 1e-3 * velocity;
    bench.step(finger, settings);
    ASSERT_LT(bench.imbalance().norm(), 1e-12) << i;
  }
  EXPECT_GT(bench.momentum().norm(), 1e-4) << "nothing was touched";
}

// What its last touch has left to be paid goes with a body.
TEST(BodyWorld, NobodyPaysWhatWasOwedToABodyThatHasGone) {
  const ServoSettings settings = test::plainServo(1000);
  Bench bench({{0.1, Vec3::Constant(0.02), Vec3(0, 0.05, 0)}}, 0, 0);
  Vec3 finger(-0.05, 0.05, 0);
  sweep(bench, settings, finger, Vec3(0.1, 0, 0), 0.4);
  sweep(bench, settings, finger, Vec3(-0.1, 0, 0), 0.4);
  bench.show({{0.1, Vec3::Constant(0.02), Vec3(0, 0.05, 0), 9}}, 0, 0);
  sweep(bench, settings, finger, Vec3(0.1, 0, 0), 0.4);
  EXPECT_GT(bench.body().velocity.x(), 0.05);
  sweep(bench, settings, finger, Vec3(-0.1, 0, 0), 0.1);
  const Vec3 velocity = bench.body().velocity;
  sweep(bench, settings, finger, Vec3::Zero(), 0.5);
  EXPECT_LT((bench.body().velocity - velocity).norm(), 1e-12);
}

// A hand remembers what it owes to kContactsOfHand bodies; light ones are owed for long.
TEST(BodyWorld, ActionIsReactionAmongMoreBodiesThanAHandRemembers) {
  std::vector<Bench::Block> row;
  for (std::size_t i = 0; i < 2 * kContactsOfHand; ++i)
    row.push_back({1e-5, Vec3(0.01, 0.002, 0.002), Vec3(0, 0.05, 0.02 * static_cast<double>(i))});
  Bench bench(row, 0, 0);
  const ServoSettings settings = test::plainServo(1000);
  Vec3 finger(-0.03, 0.05, 0);
  for (const Bench::Block& block : row) {
    finger.z() = block.at.z();
    for (const double velocity : {0.5, -0.5}) {
      for (int i = 0; i < 50; ++i) {
        finger.x() += 1e-3 * velocity;
        bench.step(finger, settings);
        ASSERT_LT(bench.imbalance().norm(), 1e-12) << block.at.z() << ' ' << i;
      }
    }
  }
  for (std::size_t i = 0; i < row.size(); ++i) EXPECT_GT(bench.body(i).velocity.x(), 0.1) << i;
}

// m dv/dt = b (u - v): the drag falls from b u to 0 while body `i` comes to the speed of the finger, within m / b or a
// step. An explicit damper drives what is lighter than b T / 2 to and fro, ever faster.
void expectDraggedToTheSpeedOfTheFinger(Bench& bench, std::size_t i, double mass_kg, double viscosity_Ns_m) {
  constexpr double kSpeed_m_s = 0.01, kDepth_m = 0.0005;
  MaterialOverride viscous;
  viscous.viscosity_Ns_m = viscosity_Ns_m;
  bench.setSurfaces(viscous);
  const ServoSettings settings = test::plainServo(1000);
  Vec3 finger(0, 0.04 + kRadius_m + kDepth_m, 0);
  sweep(bench, settings, finger, Vec3(0, -0.02, 0), 2 * kDepth_m / 0.02);
  sweep(bench, settings, finger, Vec3::Zero(), 0.1);
  const auto about = [&] { return ::testing::Message() << mass_kg << " kg, " << viscosity_Ns_m << " N s/m"; };
  for (int step = 0; step < 500; ++step) {
    finger.x() += settings.period_s * kSpeed_m_s;
    const Vec3 force = bench.step(finger, settings);
    ASSERT_LT(std::abs(force.x()), 1.01 * viscosity_Ns_m * kSpeed_m_s) << about();
    ASSERT_LT(std::abs(bench.body(i).velocity.x()), 1.02 * kSpeed_m_s) << about();
  }
  const double passed = 0.5 * viscosity_Ns_m / mass_kg;  // time constants
  if (mass_kg >= 1e-3) {                                 // lighter ones take longer: the drag on them is weaker
    EXPECT_GT(bench.body(i).velocity.x(), 0.9 * kSpeed_m_s * (1 - std::exp(-passed))) << about();
  }
}

TEST(BodyWorld, ViscosityDragsABodyOfAnyMassToTheSpeedOfTheFinger) {
  for (const double mass_kg : {1e-5, 1e-4, 1e-3, 1e-2}) {
    for (const double viscosity_Ns_m : {0.1, 1.0, 10.0}) {
      Bench bench({{mass_kg, Vec3::Constant(0.02), Vec3(0, 0.02, 0)}}, 0);
      expectDraggedToTheSpeedOfTheFinger(bench, 0, mass_kg, viscosity_Ns_m);
    }
  }
}

// In a world that goes on from another one.
TEST(BodyWorld, ViscosityDragsALightBodyOfALaterSceneToo) {
  const test::Block aside{0.1, Vec3::Constant(0.02), Vec3(0.5, 0.02, 0)};
  Bench bench({aside}, 0);
  Vec3 finger(0, 0.1, 0);
  sweep(bench, test::plainServo(1000), finger, Vec3::Zero(), 0.01);
  bench.show({aside, {1e-4, Vec3::Constant(0.02), Vec3(0, 0.02, 0)}}, 0);
  expectDraggedToTheSpeedOfTheFinger(bench, 1, 1e-4, 1);
}

TEST(BodyWorld, R25AHeavyBodyFeelsLikeAWall) {
  Bench heavy({{1e10, Vec3::Constant(0.02), Vec3(0, 0.02, 0)}}, 0.5, 0);
  Bench wall({{1e15, Vec3::Constant(0.02), Vec3(0, 0.02, 0)}}, 0.5, 0);
  const ServoSettings settings = test::plainServo(1000);
  std::mt19937_64 random(11);
  Vec3 finger(-0.03, 0.02, 0);
  for (int i = 0; i < 20000; ++i) {
    finger += Vec3(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)) * 0.0005 +
              0.001 * (Vec3(0, 0.03, 0) - finger);
    EXPECT_LT((heavy.step(finger, settings) - wall.step(finger, settings)).norm(), 1e-5) << i;
  }
}

TEST(BodyWorld, ABodyThatFallsOnTheFingerStaysOnIt) {
  Bench bench({{0.05, Vec3(0.03, 0.005, 0.03), Vec3(0, 0.06, 0)}}, 0.5);
  ServoSettings settings = test::plainServo(500);
  Vec3 finger(0, 0.03, 0);
  const Vec3 force = sweep(bench, settings, finger, Vec3::Zero(), 4);
  EXPECT_NEAR(force.y(), -0.05 * 9.81, 0.02);
  EXPECT_GT(bench.body().centre.y(), 0.03);
}

TEST(BodyWorld, AStepTakesNoMemory) {
  Bench bench({{}, {0.1, Vec3::Constant(0.02), Vec3(0.05, 0.02, 0)}}, 0.4);
  const ServoSettings settings = test::plainServo(1000);
  Vec3 finger(-0.03, 0.02, 0);
  sweep(bench, settings, finger, Vec3(0.05, 0, 0), 0.1);
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) {
    finger.x() += 0.0001;
    bench.step(finger, settings);
  }
}

// A finger of 75 g with its own damping, free, against a free body: what remains of their relative oscillation.
double ringsOn(double mass_kg, double damping_Ns_m) {
  Bench bench({{mass_kg, Vec3::Constant(0.02), Vec3(0.021, 0.06, 0)}}, 0, 0);
  const ServoSettings settings = test::plainServo(1000);
  constexpr double kFinger_kg = 0.075;
  Vec3 finger(-0.001, 0.06, 0), velocity(0.02, 0, 0);
  const double decay = std::exp(-damping_Ns_m / kFinger_kg * 1e-3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 force = bench.step(finger, settings);
    velocity = decay * velocity + (1 - decay) / damping_Ns_m * force;
    finger += 1e-3 * velocity;
  }
  const double relative = velocity.x() - bench.body().velocity.x();
  return 0.5 * relative * relative * mass_kg * kFinger_kg / (mass_kg + kFinger_kg);
}

TEST(BodyWorld, AFreeBodyThatIsHitFliesAwayWithNoMoreThanWhatHitIt) {
  for (const double mass_kg : {0.001, 0.01, 0.1, 1.0}) EXPECT_LE(ringsOn(mass_kg, 1e-3), 0.5 * 0.075 * 0.02 * 0.02);
}

// K = 1000 N/m, T = 1 ms: with bodies moved by the force of the step before, 0.25 g would be the least stable mass.
TEST(BodyWorld, R21ABodyOfAMilligramRestsOnTheFinger) {
  for (const double mass_kg : {1e-6, 1e-5, 1e-4, 2e-4, 1e-3}) {
    Bench bench({{mass_kg, Vec3(0.02, 0.001, 0.02), Vec3(0, 0.035, 0)}}, 0.5);
    Vec3 finger(0, 0.03, 0);
    const ServoSettings settings = test::plainServo(1000);
    const Vec3 force = sweep(bench, settings, finger, Vec3::Zero(), 2);
    EXPECT_NEAR(force.y(), -mass_kg * 9.81, 0.02 * mass_kg * 9.81 + 1e-9) << mass_kg;
    EXPECT_LT(bench.body().velocity.norm(), 1e-4) << mass_kg;
  }
}

// R20 with the proxy itself between: a plate lies on the finger, and the finger on the floor.
TEST(BodyWorld, ABodyOnAFingerOnTheFloorRests) {
  for (const double mass_kg : {0.001, 0.1, 1.0}) {
    Bench bench({{mass_kg, Vec3(0.03, 0.002, 0.03), Vec3(0, 0.01, 0)}}, 0.5);
    Vec3 finger(0, 0.002, 0);
    const ServoSettings settings = test::plainServo(1000);
    sweep(bench, settings, finger, Vec3::Zero(), 0.5);
    sweep(bench, settings, finger, Vec3(0, -0.005, 0), 0.4);
    sweep(bench, settings, finger, Vec3::Zero(), 1);
    EXPECT_LT(bench.body().velocity.norm(), 1e-4) << mass_kg;
    EXPECT_GE(bench.proxy().y(), kRadius_m * (1 - 1e-6)) << mass_kg;
    EXPECT_GE(bench.body().centre.y(), 0.002) << mass_kg;
  }
}

// Plates of 1 mm that fly and spin against a finger: the proxy is on the side of the plate where it began, or beside
// it.
TEST(BodyWorld, R27PlatesDoNotPassTheFinger) {
  std::mt19937_64 random(27);
  const ServoSettings settings = test::plainServo(1000);
  int touched = 0;
  for (int run = 0; run < 60; ++run) {
    const double mass_kg = std::pow(10, between(random, -3, 1)), speed = std::pow(10, between(random, -2, 1));
    const Vec3 half(0.03, 0.0005, 0.03);
    Bench bench({{mass_kg, half, Vec3(0, 0.09, 0)}}, 0, 0);
    const double spin = run % 2 == 0 ? 0 : between(random, 0, 100);
    bench.give(Vec3(0, -speed, 0), spin * Vec3(1, 0, 0.3).normalized());
    Vec3 finger(between(random, -0.01, 0.01), 0.05, between(random, -0.01, 0.01));
    bool was_over = false, was_above = false;
    for (int i = 0; i < 500 && bench.body().centre.y() > 0.035; ++i) {
      touched += bench.step(finger, settings).norm() > 0;
      const Vec3 from_plate = bench.body().turned.conjugate() * (bench.proxy() - bench.body().centre);
      const Vec3 outside = (from_plate.cwiseAbs() - half).cwiseMax(0);
      ASSERT_GE(outside.norm(), kRadius_m * (1 - 1e-3)) << run << " step " << i;
      const bool over = outside.x() == 0 && outside.z() == 0;
      const bool above = from_plate.y() > 0;
      ASSERT_FALSE(over && was_over && above != was_above) << run << " step " << i << " mass " << mass_kg;
      was_over = over;
      was_above = above;
    }
  }
  EXPECT_GT(touched, 100);
}

// What a client gives to a block that sleeps on others moves it as if it were awake.
TEST(BodyWorld, AnImpulseWakesWhatSleeps) {
  constexpr double kHalf_m = 0.01;
  for (const std::size_t high : {2, 5}) {
    std::vector<Bench::Block> tower;
    for (std::size_t i = 0; i < high; ++i)
      tower.push_back({0.02, Vec3::Constant(kHalf_m), Vec3(0, kHalf_m * (1 + 2.02 * static_cast<double>(i)), 0)});
    Bench bench(tower, 0.5);
    const ServoSettings settings = test::plainServo(1000);
    Vec3 finger(0.3, 0.3, 0);
    sweep(bench, settings, finger, Vec3::Zero(), 2);
    ASSERT_NE(bench.body(high - 1).island, 0u);
    BodyCommand command;
    command.key = bench.world().world().bodies[high - 1].key;
    command.impulse_N_s = Vec3(-0.02, 0, 0);
    command.point_m = Vec3(0, kHalf_m * (2 * static_cast<double>(high) - 1), 0);
    BodyCommands commands;
    commands.push(command);
    bench.act(commands);
    sweep(bench, settings, finger, Vec3::Zero(), 0.05);
    EXPECT_LT(bench.body(high - 1).velocity.x(), -0.9) << high;
    EXPECT_LT(bench.body(high - 1).centre.x(), -0.03) << high;
  }
}

// Two blocks that stand side by side.
const std::vector<Bench::Block> kNeighbours{{}, {0.1, Vec3::Constant(0.02), Vec3(0.041, 0.02, 0)}};

TEST(BodyWorld, ABodyWhoseStateIsNotFiniteIsPutBackAlone) {
  const ServoSettings settings = test::plainServo(1000);
  const Vec3 finger(0.3, 0.3, 0);
  std::uint64_t returned = 0;
  Bench bench(kNeighbours, 0.4);
  bench.step(finger, settings);
  for (const double wrong : {std::nan(""), HUGE_VAL}) {
    for (const bool spins : {false, true}) {
      const Vec3 none = Vec3::Zero(), broken(0, wrong, 0);
      bench.give(Vec3(1, 0, 0), none);
      bench.step(finger, settings);
      bench.give(spins ? none : broken, spins ? broken : none);
      bench.step(finger, settings);
      EXPECT_EQ(bench.world().view().returned, ++returned);
      EXPECT_NEAR((bench.body(0).centre - kNeighbours[0].at).norm(), 0, 1e-4);
      EXPECT_NEAR((bench.body(1).centre - kNeighbours[1].at).norm(), 0, 1e-2);
      EXPECT_TRUE(std::isfinite(bench.world().state().energy.change_J()));
    }
  }
}

// What the step itself makes of a pull that is no number.
TEST(BodyWorld, AStepThatComesToNoFiniteStateIsForgotten) {
  const auto scene = test::sceneOfBlocks(kNeighbours, 0.4, 9.81);
  const auto world = BodyWorld::of(*scene);
  HandAtBodies hand;
  hand.spring_N_m = 1000;
  hand.proxy = Vec3(0, 0.041, 0);
  hand.contacts.push({2, Vec3(0, 0.04, 0), Vec3::UnitY(), 0.4, 0.4, false});
  for (int step = 1; step <= 200; ++step) {
    hand.stretch = Vec3(0, step == 100 ? std::nan("") : 0.001, 0);
    world->step(step * kMs, 1e-3, {&hand, 1});
    for (std::size_t i = 0; i < kNeighbours.size(); ++i)
      ASSERT_NEAR((world->state().bodies[i].centre - kNeighbours[i].at).norm(), 0, 1e-4) << step;
  }
  EXPECT_EQ(world->view().returned, 1U);
  EXPECT_TRUE(std::isfinite(world->state().energy.change_J()));
  EXPECT_TRUE(world->owed_N_s().allFinite());
}

}  // namespace
}  // namespace hl::test_body_world
