// Random worlds with joints in a closed room: every joule is booked, nothing breaks, and joints hold.
#include <gtest/gtest.h>

#include <cmath>

#include "draws.h"
#include "joint_worlds.h"

namespace hl::test_random_joints {
namespace {

using namespace test;

constexpr double kRoom_m = 0.15;  // half of its sides

// A row of bodies, each joined to one before it, or to the world; some joints close loops.
struct RandomJoints : Draws {
  explicit RandomJoints(std::uint64_t seed) : Draws(seed) {
    world.fixed = makeSnapshot(boxModel(Vec3::Constant(kRoom_m)));
    world.gravity_m_s2 = Vec3(0, random() % 2 == 0 ? -9.81 : 0, 0);
    const int count = 2 + static_cast<int>(random() % 9);
    heaviest_kg = std::exp(between(std::log(1e-3), std::log(1.0)));
    for (int i = 0; i < count; ++i) addBody(i);
    for (int i = 0; i < count; ++i) addJoint(i, i == 0 ? -1 : static_cast<int>(random() % static_cast<unsigned>(i)));
    if (count > 3 && random() % 2 == 0) addJoint(count - 1, 0);
  }
  void addBody(int number) {
    const auto key = static_cast<std::uint64_t>(number + 1);
    const double mass_kg = heaviest_kg * std::pow(10, between(-2, 0)), size = between(0.004, 0.01);
    if (random() % 2 == 0)
      world.bodies.push_back(ball(key, mass_kg, size, between(0, 0.7), between(0, 1)));
    else
      world.bodies.push_back(block(key, mass_kg, Vec3(size, 0.6 * size, 0.4 * size), between(0, 0.7)));
    const Vec3 cell(number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1);
    poses.push_back(placeAt(0.04 * cell, Eigen::AngleAxisd(between(0, 3), direction()).toRotationMatrix()));
  }
  // `other` is -1 for the world.
  void addJoint(int of, int other) {
    const auto a = static_cast<std::size_t>(of);
    const Pose pose_b = other < 0 ? Pose() : poses[static_cast<std::size_t>(other)];
    const Vec3 middle =
        other < 0 ? Vec3(poses[a].origin + 0.02 * direction()) : Vec3((poses[a].origin + pose_b.origin) / 2);
    const auto kind = static_cast<JointKind>(random() % 5);
    Joint joint = kind == JointKind::kDistance ? distanceBetween(poses[a].origin, middle, poses[a], pose_b)
                                               : jointAt(kind, middle, direction(), poses[a], pose_b);
    if (hasCoordinate(kind)) addForces(joint);
    world.joints.push_back(named(world.joints.size() + 1, a + 1, static_cast<std::uint64_t>(other + 1), joint));
  }
  void addForces(Joint& joint) {
    const double scale = joint.kind == JointKind::kHinge ? 1e-4 : 1;  // N m for N, at 10 mm
    if (random() % 2 == 0 && joint.kind != JointKind::kDistance) joint.low = -between(0, 0.02);
    if (random() % 2 == 0 && joint.kind != JointKind::kDistance) joint.high = between(0, 0.02);
    if (random() % 2 == 0) joint.spring = scale * std::pow(10, between(0, 4));
    if (random() % 3 == 0) joint.damping = scale * std::pow(10, between(-2, 1));
    if (random() % 3 == 0) joint.friction = scale * between(0, 1);
    if (random() % 3 == 0) joint.table = {{-0.01, -0.003, 0, 0.002, 0.02}, {1, -0.5, 0.2, -0.6, -2}};
    for (double& force : joint.table.force) force *= scale * 100 * (joint.kind == JointKind::kHinge ? 1 : 0.01);
  }

  double heaviest_kg = 1;
  World world;
  std::vector<Pose> poses;
};

TEST(RandomJoints, EveryJouleIsBookedAndJointsHold) {
  const int begin = numberIn("HL_FIRST_WORLD", 0);
  std::vector<double> worst_m;
  for (int seed = begin; seed < begin + numberIn("HL_RANDOM_WORLDS", 20); ++seed) {
    RandomJoints made(static_cast<std::uint64_t>(seed));
    Playground play(made.world, made.poses);
    const double speed = made.between(0, 1);
    for (BodyState& body : play.state.bodies) body.velocity = speed * made.direction();
    const double begin_J = play.energy_J(), scale_J = 1e-3 + std::abs(begin_J);
    double off_m = 0, most_J = 0;
    for (int step = 0; step < 1000; ++step) {
      const BodyStepReport report = play.step();
      ASSERT_EQ(report.dropped, 0u);
      ASSERT_NEAR(play.energy_J() - begin_J, play.state.energy.change_J(), 1e-9 * scale_J) << seed << " step " << step;
      most_J = std::max(most_J, play.energy_J() - begin_J);
      off_m = std::max(off_m, worstOff(play));
      for (const BodyState& body : play.state.bodies)
        ASSERT_TRUE(body.centre.allFinite() && body.centre.cwiseAbs().maxCoeff() < kRoom_m) << seed << " step " << step;
    }
    // Straightening moves what light bodies at stiff springs and tables have: it is booked, and bounded.
    EXPECT_LT(most_J, 0.5 * scale_J) << seed;
    EXPECT_LT(off_m, 0.003) << seed;
    worst_m.push_back(off_m);
  }
  // A body that turns by much of a turn in a step is off for a moment; others are not.
  std::sort(worst_m.begin(), worst_m.end());
  EXPECT_LT(worst_m[worst_m.size() / 2], 1e-6);
}

}  // namespace
}  // namespace hl::test_random_joints
