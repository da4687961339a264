// What each object does to the hand: the parts make the whole, and each is what its contact says.
#include "proxy/object_forces.h"

#include <gtest/gtest.h>

#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "moving_scenes.h"
#include "proxy/proxy.h"

namespace hl::test_object_forces {
namespace {

constexpr double kRadius = 1e-3;

Vec3 sumOf(const ObjectForces& forces) {
  Vec3 sum = Vec3::Zero();
  for (const ObjectForce& one : forces) sum += one.force_N;
  return sum;
}

// A floor and two walls, each an object.
std::shared_ptr<const Snapshot> corner(double turn_rad) {
  const Pose pose{Eigen::AngleAxisd(turn_rad, Vec3(1, 2, 3).normalized()).toRotationMatrix(), Vec3(0.01, 0, 0.02)};
  return makeSnapshot({test::place(11, test::rectangle({-0.1, 0, 0.1}, {0.2, 0, 0}, {0, 0, -0.2}), Motion(pose)),
                       test::place(12, test::rectangle({0, -0.1, 0.1}, {0, 0.2, 0}, {0, 0, -0.2}), Motion(pose)),
                       test::place(13, test::rectangle({-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0}), Motion(pose))});
}

TEST(ObjectForces, TheirSumIsTheForceAtTheHand) {
  test::Random random(1);
  int several = 0, none = 0;
  for (int i = 0; i < 100; ++i) {
    const auto scene = corner(random.uniform(0, 3));
    ProxySettings settings;
    settings.radius = kRadius;
    settings.spring_N_m = random.uniform(100, 3000);
    settings.world_per_device = random.uniform(0.5, 2);
    settings.surfaces.static_friction = random.uniform(0, 0.8);
    settings.surfaces.dynamic_friction = 0.5 * *settings.surfaces.static_friction;
    settings.surfaces.stiffness = random.uniform(0.2, 1);
    settings.surfaces.adhesion_N = i % 4 == 0 ? 0.3 : 0;
    const Pose pose = scene->instances[0].motion.to();
    Vec3 finger = pose.toWorld({4e-3, 4e-3, 4e-3});
    ProxyState state = startProxy(*scene, settings, finger);
    for (int k = 0; k < 200; ++k) {
      finger = pose.toWorld(pose.toObject(finger) + 3e-4 * (random.inCube(1) - Vec3::Constant(k < 100 ? 0.2 : -0.2)));
      const TickReport report = tick(state, *scene, settings, finger);
      const ObjectForces forces = objectForces(*scene, settings, state, report, finger);
      const Vec3 hand_N = settings.spring_N_m * (report.target - finger) / settings.world_per_device;
      ASSERT_LE((sumOf(forces) - hand_N).norm(), 1e-12 * std::max(1.0, hand_N.norm())) << i << ", " << k;
      several += forces.size() > 1 ? 1 : 0;
      none += forces.empty() ? 1 : 0;
    }
  }
  EXPECT_GT(several, 1000);
  EXPECT_GT(none, 100);
}

TEST(ObjectForces, WithoutFrictionEachIsAlongItsOwnNormal) {
  const auto scene = corner(0);
  ProxySettings settings;
  settings.radius = kRadius;
  ManyRecentPrimitives recent;
  ProxyState state = startProxy(*scene, settings, Vec3(0.012, 2e-3, 0.022));
  const Vec3 finger(0.01 - 2e-3, -1e-3, 0.02 - 3e-3);
  TickReport report;
  for (int i = 0; i < 5; ++i) report = tick(state, {*scene, 0, recent}, settings, finger);
  const RealtimeGuard guard;
  const ObjectForces forces = objectForces({*scene, 0, recent}, settings, state, report, finger);
  ASSERT_EQ(forces.size(), 3u);
  for (const ObjectForce& one : forces) {
    const Vec3 expected = one.key == 11 ? Vec3(0, 2, 0) : one.key == 12 ? Vec3(3, 0, 0) : Vec3(0, 0, 4);
    EXPECT_LT((one.force_N - expected).norm(), 1e-6) << one.key;
    EXPECT_LT(std::abs((one.point - Vec3(0.01, 0, 0.02)).minCoeff()), 1e-6) << "on its surface";
  }
}

// A finger dragged over a rough floor along a smooth wall: the drag is the floor's.
TEST(ObjectForces, FrictionIsOfTheObjectThatHasSome) {
  auto scene = corner(0);
  std::vector<Instance> instances = scene->instances;
  auto rough = std::make_shared<Surfaces>(*instances[0].surfaces);
  rough->materials[0].static_friction = rough->materials[0].dynamic_friction = 0.4;
  instances[0].surfaces = rough;
  scene = makeSnapshot(std::move(instances));
  ProxySettings settings;
  settings.radius = kRadius;
  ProxyState state = startProxy(*scene, settings, Vec3(0.012, 2e-3, 0.03));
  ObjectForces forces;
  for (int i = 0; i < 100; ++i) {
    const Vec3 finger(0.01 - 1e-3, -1e-3, 0.03 + 1e-4 * i);
    const TickReport report = tick(state, *scene, settings, finger);
    forces = objectForces(*scene, settings, state, report, finger);
  }
  ASSERT_EQ(forces.size(), 2u);
  for (const ObjectForce& one : forces) {
    if (one.key == 11) {
      EXPECT_NEAR(one.force_N.y(), 2, 1e-6);
      EXPECT_NEAR(one.force_N.z(), -0.8, 1e-3) << "mu_d times the normal force, against the way";
    } else {
      EXPECT_NEAR(one.force_N.z(), 0, 1e-9);
      EXPECT_NEAR(one.force_N.x(), 2, 1e-3);
    }
  }
}

}  // namespace
}  // namespace hl::test_object_forces
