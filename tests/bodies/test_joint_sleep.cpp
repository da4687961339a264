// Joints of what sleeps: they sleep and wake with their bodies; and the same bits, whatever came first.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bodies/sleep.h"
#include "bodies/world_hash.h"
#include "joint_worlds.h"

namespace hl::test_joint_sleep {
namespace {

using namespace test;

bool allSleep(const WorldState& state) {
  return std::all_of(state.bodies.begin(), state.bodies.end(), [](const BodyState& body) { return body.island != 0; });
}
bool noneSleeps(const WorldState& state) {
  return std::all_of(state.bodies.begin(), state.bodies.end(), [](const BodyState& body) { return body.island == 0; });
}

// Steps, and demands that the energy book closes in each.
void stepsInBook(Playground& play, int count) {
  for (int i = 0; i < count; ++i) {
    const double before_J = play.energy_J(), booked_J = play.state.energy.change_J();
    play.step();
    const double booked = play.state.energy.change_J() - booked_J;
    ASSERT_NEAR(play.energy_J() - before_J, booked, 1e-9 * (1 + std::abs(before_J))) << i;
  }
}

// 1 kg, 0.4 m wide, its handle at 0.4 m from the hinge.
Playground door(const Joint& like) {
  const Vec3 middle(0.2, 0, 0);
  Joint hinge = named(1, 2, 0, jointAt(JointKind::kHinge, Vec3::Zero(), Vec3::UnitY(), placeAt(middle)));
  hinge.friction = like.friction;
  hinge.spring = like.spring;
  hinge.rest = like.rest;
  return {heavy({block(2, 1, Vec3(0.2, 0.3, 0.01), 0.5)}, {hinge}), {placeAt(middle)}};
}

TEST(JointSleep, ADoorAtRestSleepsAndWakesByAPushAtItsHandle) {
  Joint like;
  like.friction = 0.05;
  Playground play = door(like);
  stepsInBook(play, 600);
  ASSERT_TRUE(allSleep(play.state));
  const WorldState then = play.state;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(play.step().awake, 0);
  EXPECT_EQ(play.state.bodies[0].turned.coeffs(), then.bodies[0].turned.coeffs());
  EXPECT_EQ(play.state.joints[0].held, then.joints[0].held);
  HandNode hand;
  hand.stretch = Vec3(0, 0, 0.001);  // 1 N
  hand.contacts.push({2, Vec3(0.4, 0, 0.01), Vec3::UnitZ(), 0, 0, false});
  for (int i = 0; i < 20; ++i) play.step({&hand, 1});
  EXPECT_TRUE(noneSleeps(play.state));
  EXPECT_GT(std::abs(play.state.joints[0].coordinate), 1e-5);
  stepsInBook(play, 1500);
  EXPECT_TRUE(allSleep(play.state)) << "friction has stopped it";
}

TEST(JointSleep, ASpringThatFrictionHoldsKeepsItsEnergy) {
  Joint like;
  like.friction = 0.05;
  like.spring = 1;
  like.rest = 0.04;
  Playground play = door(like);
  stepsInBook(play, 600);
  ASSERT_TRUE(allSleep(play.state));
  EXPECT_EQ(play.state.joints[0].velocity, 0);
  EXPECT_NEAR(springEnergy_J(*play.world, play.state), 0.04 * 0.04 / 2, 1e-9);
  wake(*play.world, play.state, 2);
  stepsInBook(play, 100);
  EXPECT_NEAR(play.state.joints[0].coordinate, 0, 1e-9) << "it sticks as before";
}

// Ten balls that hang one below the other, the first on the world; `x`: where.
void addChain(double x, std::uint64_t first_key, std::vector<std::pair<Body, Pose>>& bodies,
              std::vector<Joint>& joints) {
  Pose above;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const Pose here = placeAt(Vec3(x, -0.05 * static_cast<double>(i + 1), 0));
    bodies.emplace_back(ball(first_key + i, 0.05, 0.01, 0.5), here);
    joints.push_back(named(first_key + i, first_key + i, i == 0 ? 0 : first_key + i - 1,
                           jointAt(JointKind::kBall, here.origin + Vec3(0, 0.05, 0), Vec3::UnitX(), here, above)));
    above = here;
  }
}

Playground made(std::vector<std::pair<Body, Pose>> bodies, std::vector<Joint> joints) {
  std::sort(bodies.begin(), bodies.end(), [](const auto& x, const auto& y) { return x.first.key < y.first.key; });
  std::sort(joints.begin(), joints.end(), [](const Joint& x, const Joint& y) { return x.key < y.key; });
  World world = heavy({}, std::move(joints));
  std::vector<Pose> poses;
  for (auto& [body, pose] : bodies) {
    world.bodies.push_back(body);
    poses.push_back(pose);
  }
  return {std::move(world), poses};
}

TEST(JointSleep, AChainSleepsAndWakesAsOne) {
  std::vector<std::pair<Body, Pose>> bodies;
  std::vector<Joint> joints;
  addChain(0, 1, bodies, joints);
  addChain(1, 101, bodies, joints);
  Playground play = made(bodies, joints);
  stepsInBook(play, 600);
  ASSERT_TRUE(allSleep(play.state));
  EXPECT_EQ(play.state.bodies[9].island, 1U);
  EXPECT_EQ(play.state.bodies[19].island, 101U);
  EXPECT_LT(worstOff(play), 1e-6);
  wake(*play.world, play.state, 107);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(play.state.bodies[i].island, i < 10 ? 1U : 0U);
  play.state.bodies[16].velocity.z() = 0.1;
  stepsInBook(play, 300);
  EXPECT_GT(std::abs(play.state.bodies[19].centre.z()), 1e-3);
  EXPECT_EQ(play.state.bodies[0].island, 1U);
  EXPECT_LT(worstOff(play), 1e-6);
}

TEST(JointSleep, WhatHitsAJoinedBodyWakesAllOfThem) {
  std::vector<std::pair<Body, Pose>> bodies;
  std::vector<Joint> joints;
  addChain(0, 1, bodies, joints);
  bodies.emplace_back(ball(50, 0.05, 0.01, 0.5), placeAt(Vec3(-1, 0, 0)));
  Playground play = made(bodies, joints);
  for (int i = 0; i < 600; ++i) {
    play.state.bodies[10].velocity.setZero();  // it waits
    play.step();
  }
  ASSERT_EQ(play.state.bodies[0].island, 1U);
  wake(*play.world, play.state, 50);
  play.state.bodies[10].centre = Vec3(-0.1, -0.5, 0);
  play.state.bodies[10].velocity = Vec3(2, 0, 0);
  stepsInBook(play, 100);
  EXPECT_TRUE(noneSleeps(play.state));
  EXPECT_GT(play.state.bodies[9].velocity.x(), 0.1);
}

// R28 with joints: ten chains swing, and sleep one after the other.
TEST(JointSleep, R28TheSameBitsWhateverTheOrder) {
  std::vector<std::pair<Body, Pose>> bodies;
  std::vector<Joint> joints;
  for (std::uint64_t i = 0; i < 10; ++i) addChain(0.1 * static_cast<double>(i), 1 + 20 * i, bodies, joints);
  Playground one = made(bodies, joints);
  std::mt19937_64 random(9);
  std::shuffle(bodies.begin(), bodies.end(), random);
  std::shuffle(joints.begin(), joints.end(), random);
  Playground other = made(bodies, joints);
  for (Playground* const play : {&one, &other}) {
    for (std::size_t i = 0; i < 50; ++i) play->state.bodies[i].velocity.x() = 0.2;
  }
  for (int step = 0; step < 700; ++step) {
    one.step();
    other.step();
    if (step == 300) other.state = WorldState(one.state);
    ASSERT_EQ(hashOf(*one.world, one.state), hashOf(*other.world, other.state)) << step;
  }
  EXPECT_EQ(one.state.bodies[99].island, 181U);
  EXPECT_EQ(one.state.bodies[0].island, 0U);
  WorldState changed = one.state;
  changed.joints[99].held[0] += 1e-15;
  EXPECT_NE(hashOf(*one.world, one.state), hashOf(*one.world, changed));
}

}  // namespace
}  // namespace hl::test_joint_sleep
