// Held bodies: what stops short again and again goes on as one with what holds it, or comes to rest.
#include <gtest/gtest.h>

#include <vector>

#include "bodies/convex_hull.h"
#include "bodies/mesh_body.h"
#include "draws.h"
#include "guard/realtime_guard.h"
#include "mesh_drawings.h"

namespace hl::test_held_bodies {
namespace {

using namespace test;

Body cup(std::uint64_t key, double half_m) {
  BodySpec spec;
  spec.shape = BodyShape::kParts;
  spec.mass_kg = 0.02;
  Body body = bodyOf(cupModel(half_m, half_m, 0.3 * half_m), spec);
  body.key = key;
  return body;
}

// They overlap by more than comes apart in a while, and fall all the same. What stops short for the first time does not
// get the velocity of the way that it has not gone.
TEST(HeldBodies, CupsThatOverlapFallAsOne) {
  for (int seed = 0; seed < 20; ++seed) {
    Draws draws(static_cast<std::uint64_t>(seed));
    World world;
    world.bodies = {cup(1, 0.015), cup(2, 0.015)};
    const auto turn = [&] { return Eigen::AngleAxisd(draws.between(0, 3), draws.direction()).toRotationMatrix(); };
    Playground play(std::move(world), {placeAt(Vec3::Zero(), turn()), placeAt(0.012 * draws.direction(), turn())});
    const double begin_m = play.state.bodies[0].centre.y() + play.state.bodies[1].centre.y();
    {
      const RealtimeGuard guard;
      play.steps(200);
    }
    const double time_s = 200 * kStep_s;
    EXPECT_NEAR(play.momentum().y(), -0.04 * kGravity * time_s, 0.15 * 0.04 * kGravity * time_s) << seed;
    const double fallen_m = (begin_m - play.state.bodies[0].centre.y() - play.state.bodies[1].centre.y()) / 2;
    EXPECT_NEAR(fallen_m, kGravity * time_s * time_s / 2, 0.2 * kGravity * time_s * time_s / 2) << seed;
  }
}

// A capsule that lies over a hull rolls off it, or stays: it is not said to move where it does not.
TEST(HeldBodies, WhatSaysThatItMovesMoves) {
  constexpr int kWindow = 100;
  for (int seed = 0; seed < numberIn("HL_HELD_WORLDS", 40); ++seed) {
    Draws draws(static_cast<std::uint64_t>(seed));
    World world;
    world.fixed = floorScene(0.5);
    std::vector<Vec3> points;
    for (int i = 0; i < 9; ++i) points.emplace_back(0.03 * draws.between(0.5, 1) * draws.direction());
    const Convex shape = hullOf(points).shape;
    const Mass inside = massOfShape(0.05, shape);
    world.bodies.push_back({1, inside, moved(shape, -inside.centre_O), {0.6, 0.6, 0}});
    world.bodies.push_back({2, massOfCapsule(0.05, 0.05, 0.013), capsuleShape(0.05, 0.013), {0.6, 0.6, 0}});
    const auto turn = [&] { return Eigen::AngleAxisd(draws.between(0, 3), draws.direction()).toRotationMatrix(); };
    Playground play(std::move(world), {placeAt(Vec3(0, 0.04, 0), turn()), placeAt(Vec3(0.01, 0.14, 0), turn())});
    for (int window = 0; window < 20; ++window) {
      const Vec3 begin = play.state.bodies[1].centre;
      double slowest_m_s = 1e9, way_m = 0;
      Vec3 last = begin;
      for (int step = 0; step < kWindow; ++step) {
        play.step();
        const BodyState& capsule = play.state.bodies[1];
        slowest_m_s = std::min(slowest_m_s, capsule.velocity.norm());
        way_m += (capsule.centre - last).norm();
        last = capsule.centre;
      }
      if (slowest_m_s > 0.01) {
        EXPECT_GT(way_m, 0.5 * slowest_m_s * kWindow * kStep_s) << seed << " window " << window;
      }
    }
  }
}

}  // namespace
}  // namespace hl::test_held_bodies
