// Bodies against closed forms; numbers R1.. are those of docs/bodies.md.
#include <gtest/gtest.h>

#include <cmath>

#include "draws.h"
#include "guard/realtime_guard.h"
#include "test_worlds.h"

namespace hl::test_body_step {
namespace {

using namespace test;

TEST(BodyStep, R8AThrownBodyFliesAParabolaToTheLastDigits) {
  World world;
  world.bodies = {ball(1, 0.1, 0.01, 0)};
  Playground play(std::move(world), {placeAt(Vec3::Zero())});
  const double speed = 2 * std::sqrt(0.5);
  play.state.bodies[0].velocity = Vec3(speed, speed, 0);
  const double begin_J = play.energy_J();
  for (int i = 1; i <= 288; ++i) {
    play.step();
    const double t = i * kStep_s;
    EXPECT_NEAR(play.state.bodies[0].centre.x(), speed * t, 1e-12);
    EXPECT_NEAR(play.state.bodies[0].centre.y(), speed * t - kGravity * t * t / 2, 1e-12);
  }
  EXPECT_NEAR(play.energy_J(), begin_J, 1e-12);
}

TEST(BodyStep, ABlockOnTheFloorStaysWhereItIs) {
  World world;
  world.fixed = floorScene();
  world.bodies = {block(1, 0.1, Vec3::Constant(0.02), 0.5)};
  Playground play(std::move(world), {placeAt(Vec3(0.1, 0.02, 0.03))});
  play.steps(400);
  double pressed = 0;
  for (const Row& row : play.stepper.rows()) pressed += row.pressed;
  EXPECT_NEAR(pressed / kStep_s, 0.1 * kGravity, 1e-9);
  play.steps(1600);
  const BodyState& body = play.state.bodies[0];
  EXPECT_LT((body.centre - Vec3(0.1, 0.02, 0.03)).norm(), 1e-9);
  EXPECT_LT(body.velocity.norm() + body.spin.norm(), 1e-9);
}

TEST(BodyStep, R5TwoBallsThatCollideWithRestitutionHalf) {
  World world;
  world.gravity_m_s2.setZero();
  world.bodies = {ball(1, 0.2, 0.01, 0, 0.5), ball(2, 0.1, 0.01, 0, 0.5)};
  Playground play(std::move(world), {placeAt(Vec3::Zero()), placeAt(Vec3(0.0503, 0, 0))});
  play.state.bodies[0].velocity = Vec3(0.5, 0, 0);
  const double begin_J = play.energy_J();
  play.steps(200);
  EXPECT_NEAR(play.state.bodies[0].velocity.x(), 0.25, 1e-12);
  EXPECT_NEAR(play.state.bodies[1].velocity.x(), 0.5, 1e-12);
  EXPECT_NEAR(begin_J - play.energy_J(), 6.25e-3, 1e-12);
  EXPECT_NEAR(play.state.energy.contact_J, 6.25e-3, 1e-12);
}

// x of the body's face -x where the line y = `y`, z = 0 meets it.
double faceAt(const BodyState& body, double half_m, double y) {
  const Vec3 normal = body.turned * -Vec3::UnitX();
  const Vec3 middle = body.centre + half_m * normal;
  return middle.x() + normal.y() * (middle.y() - y) / normal.x();
}

// Sum of the normal forces between two bodies; 0 is the scene.
double pressedBetween(const Playground& play, std::uint64_t a, std::uint64_t b) {
  double sum = 0;
  for (const Row& row : play.stepper.rows()) {
    if (row.pair.a == a && row.pair.b == b) sum += row.pressed;
  }
  return sum / play.period_s;
}

struct Pushed {
  double last_N = 0, highest_N = 0;
};

// A finger pushes block 1 (half side `half_m`, on the floor) toward +x at height `y` at this speed.
Pushed push(Playground& play, double half_m, double y, double speed, double seconds) {
  Pusher finger;
  finger.finger = Vec3(faceAt(play.state.bodies[0], half_m, y), y, 0);
  finger.proxy = finger.finger;
  Pushed out;
  for (double t = 0; t < seconds; t += play.period_s) {
    finger.finger.x() += speed * play.period_s;
    const HandNode node = finger.node();
    play.step({&node, 1});
    finger.tick(faceAt(play.state.bodies[0], half_m, y), play.period_s, play.given[0]);
    out.last_N = -finger.force_N.x();
    out.highest_N = std::max(out.highest_N, out.last_N);
  }
  return out;
}

World onFloor(double friction, std::vector<Body> bodies) {
  World world;
  world.fixed = floorScene(10);
  world.fixed_surface = {friction, friction, 0};
  world.bodies = std::move(bodies);
  return world;
}

// What rings between the finger and the block decays by theta w^2 T = 10 / s alone (w^2 = K / m): to 1e-10 in 5 s.
TEST(BodyStep, R1ABlockThatIsPushedOverTheFloor) {
  for (const double speed : {0.001, 0.01, 0.1}) {
    Playground play(onFloor(0.4, {block(1, 0.1, Vec3::Constant(0.02), 0.4)}), {placeAt(Vec3(0, 0.02, 0))});
    play.steps(10);
    EXPECT_NEAR(push(play, 0.02, 0.02, speed, 5).last_N, 0.3924, 1e-7) << speed;
  }
}

// The block sticks up to 0.6 m g and then slips: half a turn of the finger's spring about 0.4 m g. The node's mass K
// T^2 damps it by e^(-pi w T / 2), w^2 = K / m; without, the force falls to 0.1962 N, after 0.574 mm in 36.4 ms.
TEST(BodyStep, R2ABlockThatSticksAndSlips) {
  for (const double period_s : {1e-3, 1e-4, 2e-5}) {
    World world = onFloor(0, {block(1, 0.1, Vec3::Constant(0.02), 0)});
    world.fixed_surface = world.bodies[0].surface = {0.6, 0.4, 0};
    Playground play(std::move(world), {placeAt(Vec3(0, 0.02, 0))}, period_s);
    play.steps(10);
    Pusher finger;
    finger.finger = finger.proxy = Vec3(faceAt(play.state.bodies[0], 0.02, 0.02), 0.02, 0);
    double highest_N = 0, slipped_s = 0, first = play.state.bodies[0].centre.x();
    while (slipped_s == 0 || play.state.bodies[0].velocity.x() > 1e-6) {
      finger.finger.x() += 0.005 * period_s;
      const HandNode node = finger.node();
      play.step({&node, 1});
      finger.tick(faceAt(play.state.bodies[0], 0.02, 0.02), period_s, play.given[0]);
      highest_N = std::max(highest_N, -finger.force_N.x());
      if (play.state.bodies[0].velocity.x() > 1e-6) slipped_s += period_s;
      ASSERT_LT(finger.finger.x(), 0.01);
    }
    const double kept = std::exp(-EIGEN_PI * 100 * period_s / 2),
                 coarse = 5 * period_s;  // N, what the finger adds in a step
    EXPECT_NEAR(highest_N, 0.3924 + std::hypot(0.1962, 0.05), 0.001 + coarse);
    EXPECT_NEAR(-finger.force_N.x(), 0.3924 - 0.1962 * kept, 0.001 + 2 * coarse);
    EXPECT_NEAR(slipped_s, 0.0364, 2 * period_s);
    EXPECT_NEAR(play.state.bodies[0].centre.x() - first, 0.574e-3 * (1 + kept) / 2, 3e-6 + 0.01 * period_s);
  }
}

TEST(BodyStep, R3ThreeBlocksInARow) {
  // Nearly smooth sides: friction there would hold up a part of the weight.
  Playground play(onFloor(90, {block(1, 0.1, Vec3::Constant(0.02), 0.001), block(2, 0.2, Vec3::Constant(0.02), 0.001),
                               block(3, 0.3, Vec3::Constant(0.02), 0.001)}),
                  {placeAt(Vec3(0, 0.02, 0)), placeAt(Vec3(0.04, 0.02, 0)), placeAt(Vec3(0.08, 0.02, 0))});
  play.steps(10);
  EXPECT_NEAR(push(play, 0.02, 0.02, 0.001, 12).last_N, 1.7658, 1e-5);
  EXPECT_NEAR(pressedBetween(play, 1, 2), 1.4715, 5e-4);
  EXPECT_NEAR(pressedBetween(play, 2, 3), 0.8829, 5e-4);
}

// 31.4 ms of contact; without damping 1.000 N and away at 2 u. The node's mass K T^2 damps by w^2 T / 2 = 5 / s.
TEST(BodyStep, R4AFingerHitsABlockOnAFloorWithoutFriction) {
  World world;
  world.gravity_m_s2.setZero();
  world.bodies = {block(1, 0.1, Vec3::Constant(0.02), 0)};
  Playground play(std::move(world), {placeAt(Vec3(0.02, 0, 0))});
  Pusher finger;
  double highest_N = 0;
  int touching = 0;
  Vec3 impulses = Vec3::Zero();
  for (int i = 0; i < 100; ++i) {
    finger.finger.x() += 0.1 * kStep_s;
    const HandNode node = finger.node();
    play.step({&node, 1});
    finger.tick(faceAt(play.state.bodies[0], 0.02, 0), kStep_s, play.given[0]);
    highest_N = std::max(highest_N, -finger.force_N.x());
    touching += finger.touching ? 1 : 0;
    impulses += kStep_s * finger.force_N;
    const Vec3 owed = finger.owed.empty() ? Vec3::Zero() : finger.owed[0].impulse_N_s;
    EXPECT_LT((impulses + play.momentum() + owed).norm(), 1e-12);
  }
  const double half_turn = EIGEN_PI * 100 * kStep_s / 2;
  EXPECT_NEAR(play.state.bodies[0].velocity.x(), 0.1 * (1 + std::exp(-half_turn)), 0.002 * 0.2);
  EXPECT_NEAR(highest_N, std::exp(-half_turn / 2), 0.002);
  EXPECT_NEAR(touching, 31.4, 1.1);
}

TEST(BodyStep, R15AStackOfFivePressedWithTwoNewtons) {
  std::vector<Body> bodies;
  std::vector<Pose> poses;
  for (int i = 0; i < 5; ++i) {
    bodies.push_back(block(static_cast<std::uint64_t>(i + 1), 0.05, Vec3::Constant(0.01), 0.5));
    poses.push_back(placeAt(Vec3(0, 0.01 + 0.02 * i, 0)));
  }
  Playground play(onFloor(0.5, bodies), poses);
  HandNode hand;
  hand.stretch = Vec3(0, 0.002, 0);
  hand.contacts.push({5, Vec3(0, 0.1, 0), Vec3::UnitY(), 0, 0, false});
  for (int i = 0; i < 3000; ++i) play.step({&hand, 1});
  const std::array<double, 4> above{2.4905, 2.9810, 3.4715, 3.9620};
  for (std::uint64_t i = 0; i < 4; ++i) EXPECT_NEAR(pressedBetween(play, 4 - i, 5 - i), above[i], 1e-6) << i;
  EXPECT_NEAR(pressedBetween(play, 1, 0), 4.4525, 1e-6);
  for (int i = 0; i < 5; ++i)
    EXPECT_LT(
        (play.state.bodies[static_cast<std::size_t>(i)].centre - poses[static_cast<std::size_t>(i)].origin).norm(),
        1e-6);
  for (const BodyState& body : play.state.bodies) EXPECT_LT(body.velocity.norm(), 1e-6);
}

TEST(BodyStep, AFirstFallOntoTheFloorIsRtSafe) {
  World world;
  world.fixed = floorScene();
  world.bodies = {block(1, 0.1, Vec3::Constant(0.02), 0.5), ball(2, 0.1, 0.01, 0.5)};
  Playground play(world, {placeAt(Vec3(0, 0.021, 0)), placeAt(Vec3(0.1, 0.011, 0))});
  {
    const RealtimeGuard guard;
    play.steps(100);
  }
  EXPECT_NEAR(play.state.bodies[0].centre.y(), 0.02, 1e-6);
}

// Awake all the time. HL_STACK_STEPS sets how long: 3600000 are an hour.
TEST(BodyStep, AStackOfTenStandsWithoutMoving) {
  constexpr double kHalf_m = 0.02;
  World world;
  world.fixed = floorScene();
  std::vector<Pose> poses;
  for (int i = 0; i < 10; ++i) {
    world.bodies.push_back(block(static_cast<std::uint64_t>(i) + 1, 0.1, Vec3::Constant(kHalf_m), 0.5));
    poses.push_back(placeAt(Vec3(0, (2 * i + 1) * kHalf_m, 0)));
  }
  Playground play(world, poses);
  play.steps(100);  // in the first nothing bears yet, and all falls by g T^2 / 2
  const std::vector<BodyState> settled = play.state.bodies;
  const int steps = numberIn("HL_STACK_STEPS", 20'000);
  double farthest_m = 0;
  for (int step = 0; step < steps; ++step) {
    for (BodyState& body : play.state.bodies) body.still_s = 0;
    play.step();
    for (std::size_t i = 0; i < poses.size(); ++i)
      farthest_m = std::max(farthest_m, (play.state.bodies[i].centre - settled[i].centre).norm());
  }
  EXPECT_LT(farthest_m, 1e-8);
}

TEST(BodyStep, R16ACubePushedAboveItsMiddleSlidesOrTips) {
  for (const auto& [friction, force] : {std::pair{0.5, 0.4905}, std::pair{0.6, 0.5450}}) {
    Playground play(onFloor(friction, {block(1, 0.1, Vec3::Constant(0.02), friction)}), {placeAt(Vec3(0, 0.02, 0))});
    play.steps(10);
    const Pushed pushed = push(play, 0.02, 0.036, 0.0001, 8);
    EXPECT_NEAR(pushed.highest_N, force, 2e-3) << friction;
    const double tilt = 2 * std::abs(play.state.bodies[0].turned.z());
    EXPECT_EQ(tilt > 0.003, friction > 0.55) << tilt;
  }
}

// a = 5 F / 7 m while it rolls; (F - mu m g) / m where the floor is too smooth.
TEST(BodyStep, R17ABallPushedAtItsMiddleRollsOrSlips) {
  for (const auto& [friction, acceleration] : {std::pair{0.08, 1.7857142857}, std::pair{0.05, 2.0095}}) {
    Playground play(onFloor(friction, {ball(1, 0.2, 0.02, friction)}), {placeAt(Vec3(0, 0.02, 0))});
    play.steps(10);
    for (int i = 0; i < 200; ++i) {
      HandNode hand;  // it owes the impulse of 0.5 N in each step, and its spring is next to nothing
      hand.spring_N_m = 1e-6;
      hand.owed.push({1, play.state.bodies[0].centre, Vec3(0.5 * kStep_s, 0, 0)});
      play.step({&hand, 1});
    }
    EXPECT_NEAR(play.state.bodies[0].velocity.x() / 0.2, acceleration, 1e-6) << friction;
  }
}

TEST(BodyStep, R18ABallAndABlockOnAnIncline) {
  const double slope = 20 * EIGEN_PI / 180;
  const Vec3 up(-std::sin(slope), std::cos(slope), 0), down(-std::cos(slope), -std::sin(slope), 0);
  const Mat3 turned = Eigen::AngleAxisd(slope, Vec3::UnitZ()).toRotationMatrix();
  for (const double friction : {0.36, 0.37}) {
    World world;
    world.fixed = floorScene(1, slope);
    world.fixed_surface = {friction, friction, 0};
    world.bodies = {ball(1, 0.2, 0.02, friction), block(2, 0.1, Vec3::Constant(0.02), friction)};
    Playground play(std::move(world), {placeAt(0.02 * up), placeAt(0.02 * up + Vec3(0, 0, 0.3), turned)});
    play.steps(500);
    EXPECT_NEAR(play.state.bodies[0].velocity.dot(down) / 0.5, 2.39658, 1e-5);
    const double slides = std::max(0.0, kGravity * (std::sin(slope) - friction * std::cos(slope)));
    EXPECT_NEAR(play.state.bodies[1].velocity.dot(down) / 0.5, friction > std::tan(slope) ? 0 : slides, 1e-6);
  }
}

TEST(BodyStep, R20ABodyPinchedBetweenAFingerAndAWall) {
  for (const double mass : {0.001, 0.1, 10.0}) {
    for (const double spring : {300.0, 5000.0}) {
      World world = onFloor(0, {block(1, mass, Vec3::Constant(0.02), 0)});
      world.gravity_m_s2.setZero();
      Playground play(std::move(world), {placeAt(Vec3(0, 0.02, 0))});
      HandNode hand;
      hand.spring_N_m = spring;
      hand.stretch = Vec3(0, 0.001, 0);
      hand.contacts.push({1, Vec3(0, 0.04, 0), Vec3::UnitY(), 0, 0, false});
      for (int i = 0; i < 2000; ++i) play.step({&hand, 1});
      EXPECT_NEAR(pressedBetween(play, 1, 0), spring * 0.001, 1e-9 * spring) << mass;
      EXPECT_LT((play.state.bodies[0].centre - Vec3(0, 0.02, 0)).norm(), 1e-9);
    }
  }
}

// Without friction or gravity a body turns as Euler's equations say.
TEST(BodyStep, R23ATopKeepsItsMomentumAndEnergy) {
  World world;
  world.gravity_m_s2.setZero();
  world.bodies = {block(1, 0.1, Vec3(0.01, 0.02, 0.04), 0)};
  Playground play(std::move(world), {placeAt(Vec3::Zero())});
  play.state.bodies[0].spin = Vec3(0.01, 20, 0.01);
  const auto momentum = [&] {
    return Vec3(inertiaOf(play.world->bodies[0], play.state.bodies[0]) * play.state.bodies[0].spin);
  };
  const Vec3 begin = momentum();
  const double begin_J = play.energy_J();
  double worst = 0;
  for (int i = 0; i < 10000; ++i) {
    play.step();
    worst = std::max(worst, std::abs(play.energy_J() / begin_J - 1));
  }
  EXPECT_LT((momentum() - begin).norm(), 1e-12 * begin.norm() * 100);
  EXPECT_LT(worst, 1e-6);
}

// Identity of energy_book.h with balls and blocks that fall onto each other and bounce.
TEST(BodyStep, WhatIsTooFastIsSlowedAndReported) {
  World world;
  world.fixed = floorScene();
  world.bodies = {block(1, 1e-6, Vec3::Constant(1e-3), 0.5), ball(2, 1, 0.01, 0.5)};
  Playground room(world, {placeAt(Vec3(0, 0.5, 0)), placeAt(Vec3(0.003, 0.51, 0))});
  for (const double speed : {1e4, 1e30, 1e150}) {
    room.state.bodies[0].velocity = Vec3(-speed, speed, 0);
    room.state.bodies[0].spin = Vec3(0, speed, -speed);
    const double before_J = room.energy_J() - room.state.energy.change_J();
    room.step();
    EXPECT_LE(room.state.bodies[0].velocity.norm(), 1.1 * kFastest_m_s) << speed;
    EXPECT_TRUE(room.state.bodies[0].spin.allFinite()) << speed;
    const double after_J = room.energy_J() - room.state.energy.change_J();
    EXPECT_NEAR(after_J, before_J, 1e-9 * std::max(1.0, std::abs(before_J))) << speed;
  }
}

TEST(BodyStep, TheEnergyBookHoldsEveryJoule) {
  std::vector<Body> bodies;
  std::vector<Pose> poses;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const double size = 0.01 + 0.001 * static_cast<double>(i);
    bodies.push_back(i % 2 == 0 ? ball(i + 1, 0.05, size, 0.3, 0.6) : block(i + 1, 0.05, Vec3::Constant(size), 0.3));
    poses.push_back(
        placeAt(Vec3(0.01 * static_cast<double>(i % 3), 0.03 + 0.05 * static_cast<double>(i), 0.005),
                Eigen::AngleAxisd(0.3 * static_cast<double>(i), Vec3(1, 2, 3).normalized()).toRotationMatrix()));
  }
  Playground play(onFloor(0.5, bodies), poses);
  const double begin_J = play.energy_J();
  double deepest = 0;
  for (int i = 0; i < 2000; ++i) {
    deepest = std::max(deepest, play.step().deepest);
    const EnergyBook& book = play.state.energy;
    EXPECT_NEAR(play.energy_J() - begin_J, book.by_hand_J - book.contact_J - book.friction_J + book.solver_J, 1e-12);
  }
  EXPECT_LT(deepest, 1e-4);
  for (const BodyState& body : play.state.bodies) EXPECT_GT(body.centre.y(), 0);
}

}  // namespace
}  // namespace hl::test_body_step
