// How far bodies may go in a step, against a judge that compares each with each.
#include "bodies/motion_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "draws.h"
#include "guard/realtime_guard.h"
#include "test_worlds.h"

namespace hl::test_motion_bounds {
namespace {

using namespace test;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

struct Balls {
  explicit Balls(Draws& draws) {
    const auto count = static_cast<std::uint64_t>(draws.between(1, 40));
    const double room_m = std::pow(10.0, draws.between(-2, 1));
    for (std::uint64_t key = 1; key <= count; ++key) {
      world.bodies.push_back(ball(key, 0.1, std::pow(10.0, draws.between(-3, -1)), 0));
      poses.push_back(placeAt(room_m * Vec3(draws.between(-1, 1), draws.between(-1, 1), draws.between(-1, 1))));
    }
    state = startWorld(world, poses);
    for (BodyState& body : state.bodies) {
      body.velocity = std::pow(10.0, draws.between(-3, 2)) * draws.direction();
      if (draws.between(0, 1) < 0.2) body.island = 1;
    }
  }

  bool sleeps(std::size_t body) const { return state.bodies[body].island != 0; }
  bool near(std::size_t a, std::size_t b, const std::vector<double>& ways) const {
    const double reach = world.bodies[a].shape.reach + world.bodies[b].shape.reach + ways[a] + ways[b];
    return (state.bodies[a].centre - state.bodies[b].centre).squaredNorm() <= reach * reach;
  }

  World world;
  std::vector<Pose> poses;
  WorldState state;
};

// A problem whose awake bodies have the velocities of the state.
struct Bounded {
  explicit Bounded(const Balls& balls) : problem(std::make_shared<const World>(balls.world)) {
    problem.nodes.resize(problem.bodies());
    for (std::size_t i = 0; i < problem.bodies(); ++i) {
      problem.nodes[i].centre = balls.state.bodies[i].centre;
      problem.nodes[i].velocity = balls.state.bodies[i].velocity;
      if (!balls.sleeps(i)) problem.awake.push_back(i);
    }
    bounds.find(balls.state, {}, 0);
  }

  BodyProblem problem;
  JointRows joints{problem};
  MotionBounds bounds{problem, joints};
};

// Each awake body has the speed of the fastest that it may meet, until nothing changes. `times`: how often it did.
std::vector<double> judgedWays(const Balls& balls, const Bounded& bounded, int& times) {
  const std::size_t count = balls.world.bodies.size();
  std::vector<double> ways(count, 0);
  const auto way = [&](double speed) { return 2 * bounded.problem.period_s * speed + kTouching_m; };
  for (const std::size_t i : bounded.problem.awake) ways[i] = way(balls.state.bodies[i].velocity.norm());
  times = 0;
  for (bool changed = true; changed; ++times) {
    changed = false;
    std::set<Pair> pairs;
    for (std::uint32_t a = 0; a < count; ++a) {
      for (std::uint32_t b = a + 1; b < count; ++b) {
        if (!balls.sleeps(a) && !balls.sleeps(b) && balls.near(a, b, ways)) pairs.insert({a, b});
      }
    }
    for (bool spread = true; spread;) {
      spread = false;
      for (const auto& [a, b] : pairs) {
        const double most = std::max(ways[a], ways[b]);
        spread |= ways[a] != ways[b];
        changed |= ways[a] != ways[b];
        ways[a] = ways[b] = most;
      }
    }
  }
  return ways;
}

TEST(MotionBounds, AreOfTheFastestThatABodyMayMeet) {
  Draws draws(1);
  int whole = 0, alone = 0;
  for (int i = 0; i < 1000; ++i) {
    const Balls balls(draws);
    const Bounded bounded(balls);
    int times = 0;
    const std::vector<double> judged = judgedWays(balls, bounded, times);
    const std::vector<double>& found = bounded.bounds.ways().bodies;
    for (std::size_t body = 0; body < found.size(); ++body) {
      ASSERT_GE(found[body], judged[body] * (1 - 1e-12)) << i;
      if (times <= 3) {
        ASSERT_DOUBLE_EQ(found[body], judged[body]) << i;
      }
    }
    const std::set<double> different(found.begin(), found.end());
    (different.size() > 2 ? alone : whole) += 1;
  }
  EXPECT_GT(alone, 200);
  EXPECT_GT(whole, 200);
}

// In the order opposite to that of the first step, so many exchanges of neighbours would be a matter of minutes.
TEST(SweepAndPrune, AWorldThatBeginsIsSortedAtOnceAndInPlace) {
  constexpr std::size_t kBodies = 100'000;
  World world;
  WorldState state;
  for (std::size_t i = 0; i < kBodies; ++i) {
    world.bodies.push_back(test::ball(i + 1, 1, 0.1, 0));
    state.bodies.emplace_back().centre.x() = -static_cast<double>(i);
  }
  SweepAndPrune near(world);
  {
    const RealtimeGuard guard;
    near.sort(state);
  }
  std::size_t pairs = 0;
  near.forEachPair(state, std::vector<double>(kBodies, 0.5), [&](std::uint32_t, std::uint32_t) { ++pairs; });
  EXPECT_EQ(pairs, kBodies - 1);
}

TEST(SweepAndPrune, FindsEachNearPairOnce) {
  Draws draws(2);
  std::size_t all = 0;
  for (int i = 0; i < 1000; ++i) {
    const Balls balls(draws);
    std::vector<double> ways(balls.world.bodies.size());
    for (std::size_t body = 0; body < ways.size(); ++body) ways[body] = balls.sleeps(body) ? 0 : draws.between(0, 0.02);
    SweepAndPrune near(balls.world);
    near.sort(balls.state);
    std::set<Pair> found, judged;
    near.forEachPair(balls.state, ways, [&](std::uint32_t one, std::uint32_t other) {
      EXPECT_FALSE(balls.sleeps(one));
      EXPECT_TRUE(found.insert(std::minmax({one, other})).second) << "twice";
    });
    for (std::uint32_t a = 0; a < ways.size(); ++a) {
      for (std::uint32_t b = a + 1; b < ways.size(); ++b) {
        if (!(balls.sleeps(a) && balls.sleeps(b)) && balls.near(a, b, ways)) judged.insert({a, b});
      }
    }
    ASSERT_EQ(found, judged) << i;
    all += found.size();
  }
  EXPECT_GT(all, 1000U);
}

// A stack beside which something fast flies by, a metre away, is the stack alone, to the bit.
TEST(MotionBounds, WhatIsFastElsewhereChangesNothing) {
  const auto played = [](bool beside) {
    World world;
    world.fixed = floorScene();
    std::vector<Pose> poses;
    for (std::uint64_t key = 1; key <= 5; ++key) {
      world.bodies.push_back(block(key, 0.1, Vec3::Constant(0.01), 0.5));
      poses.push_back(placeAt(Vec3(1e-3 * static_cast<double>(key % 2), 0.02 * static_cast<double>(key) - 0.01, 0)));
    }
    if (beside) {
      world.bodies.push_back(ball(6, 0.1, 0.01, 0));
      poses.push_back(placeAt(Vec3(0, 1.5, 0)));
    }
    Playground play(std::move(world), poses);
    play.state.bodies[0].velocity = Vec3(0.05, 0, 0.02);
    if (beside) play.state.bodies[5].velocity = Vec3(0, 40, 0);
    play.steps(300);
    play.state.bodies.resize(5);
    return play.state.bodies;
  };
  const std::vector<BodyState> alone = played(false), beside = played(true);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].centre, beside[i].centre) << i;
    EXPECT_EQ(alone[i].velocity, beside[i].velocity) << i;
    EXPECT_EQ(alone[i].spin, beside[i].spin) << i;
  }
}

}  // namespace
}  // namespace hl::test_motion_bounds
