// What a hand owes to bodies: whatever it feels and they get, no impulse is lost.
#include "touch/hand_account.h"

#include <gtest/gtest.h>

#include <random>

namespace hl::test_hand_account {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr std::uint64_t kBodies = 20;

World worldOfBodies() {
  World world;
  world.bodies.resize(kBodies);
  for (std::uint64_t i = 0; i < kBodies; ++i) world.bodies[i].key = i + 1;
  return world;
}

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  std::size_t upTo(std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random_); }
  Vec3 vec() { return {one(), one(), one()}; }
  // A body, or what does not move.
  std::uint64_t key() { return upTo(kBodies); }

 private:
  double one() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  std::mt19937 random_;
};

ObjectForces drawForces(Draw& draw) {
  ObjectForces forces;
  for (std::size_t i = draw.upTo(ObjectForces::capacity()); i > 0; --i)
    forces.push({draw.key(), draw.vec(), draw.vec()});
  return forces;
}

// What a solve gives: first of what is owed some, in its order, then to other bodies and to what does not move.
GivenImpulses drawGiven(Draw& draw, const OwedImpulses& owed) {
  GivenImpulses given;
  for (const BodyImpulse& one : owed) {
    if (draw.upTo(2) > 0) given.push({one.key, one.point, one.impulse_N_s});
  }
  const std::uint64_t first = 1 + draw.upTo(kBodies - kContactsOfHand - 1);
  for (std::uint64_t i = 0; i < draw.upTo(kContactsOfHand); ++i) given.push({first + i, draw.vec(), draw.vec()});
  given.push({0, draw.vec(), draw.vec()});
  return given;
}

Vec3 sumOf(const auto& impulses) {
  Vec3 sum = Vec3::Zero();
  for (const BodyImpulse& one : impulses) sum += one.impulse_N_s;
  return sum;
}

// On the bodies alone: what a wall took may also be taken from a body that is pinched against it.
TEST(HandAccount, NoImpulseIsLostHoweverManyBodiesItIsOwedTo) {
  const World world = worldOfBodies();
  Draw draw(1);
  HandAccount account;
  for (int step = 0; step < 20'000; ++step) {
    account.beginStep();
    const Vec3 before = account.sum_N_s();
    const GivenImpulses given = drawGiven(draw, account.owed());
    account.pay(given);
    ObjectForces forces;
    Vec3 felt = Vec3::Zero();
    for (const ObjectForce& force : drawForces(draw)) {
      if (force.key == 0) continue;
      forces.push(force);
      felt += kPeriod_s * force.force_N;
    }
    Vec3 by_wall = Vec3::Zero();
    for (const BodyImpulse& one : given) by_wall += one.key == 0 ? one.impulse_N_s : Vec3::Zero();
    const Vec3 of_bodies = sumOf(given) - by_wall;
    const Vec3 at_once = sumOf(account.settle(world, forces, kPeriod_s));
    const Vec3 lost = before - felt - of_bodies - at_once - account.sum_N_s();
    // Of a body that is pinched against the wall, what the wall gave is subtracted too.
    ASSERT_LT(std::min(lost.norm(), (lost - by_wall).norm()), 1e-12) << step;
  }
}

TEST(HandAccount, WhatIsOwedTheLeastIsGivenAtOnce) {
  const World world = worldOfBodies();
  HandAccount account;
  ObjectForces forces;
  ChangedImpulses at_once;
  for (std::uint64_t key = 1; key <= kContactsOfHand + 2; ++key) {
    forces.clear();
    forces.push({key, Vec3::Zero(), Vec3(static_cast<double>(key), 0, 0)});
    at_once = account.settle(world, forces, kPeriod_s);
    ASSERT_EQ(at_once.size(), key > kContactsOfHand ? 1u : 0u);
  }
  EXPECT_EQ(at_once[0].key, 2u);
  EXPECT_DOUBLE_EQ(at_once[0].impulse_N_s.x(), -2 * kPeriod_s);
  EXPECT_EQ(account.owed().size(), kContactsOfHand);
}

TEST(HandAccount, WhatFieldsTakeIsGivenOnceAndInWhole) {
  const World world = worldOfBodies();
  HandAccount account;
  FieldForces fields;
  fields.forces.push({3, Vec3::UnitX(), Vec3(0, 2, 0)});
  fields.forces.push({0, Vec3::UnitX(), Vec3(0, 5, 0)});
  account.draw(world, fields, kPeriod_s);
  EXPECT_EQ(account.sum_N_s(), Vec3(0, -2 * kPeriod_s, 0));
  const DrawnImpulses drawn = account.takeDrawn();
  ASSERT_EQ(drawn.size(), 1u);
  EXPECT_EQ(drawn[0].key, 3u);
  EXPECT_EQ(drawn[0].point, Vec3::UnitX());
  EXPECT_TRUE(account.takeDrawn().empty());
}

}  // namespace
}  // namespace hl::test_hand_account
