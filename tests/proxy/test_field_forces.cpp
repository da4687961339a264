// Fields: forces on the hand from places, by their formulas; the energy that each can give; and what acts at once.
#include "proxy/field_forces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "moving_scenes.h"

namespace hl::test_field_forces {
namespace {

FieldSpec magnet(std::vector<Vec3> points, double reach_m = 0.03, double force_N = 2) {
  FieldSpec field;
  field.kind = FieldKind::kMagnet;
  field.points = std::move(points);
  field.reach_m = reach_m;
  field.force_N = force_N;
  return field;
}
FieldSpec spring(const Vec3& point, double reach_m, double stiffness_N_m, double force_N) {
  FieldSpec field = magnet({point}, reach_m, force_N);
  field.kind = FieldKind::kSpring;
  field.stiffness_N_m = stiffness_N_m;
  return field;
}
FieldSpec constant(const Vec3& point, double reach_m, double force_N, const Vec3& direction) {
  FieldSpec field = magnet({point}, reach_m, force_N);
  field.kind = FieldKind::kConstant;
  field.direction = direction;
  return field;
}
FieldSpec drag(const Vec3& point, double reach_m, double damping_Ns_m) {
  FieldSpec field = magnet({point}, reach_m, 0);
  field.kind = FieldKind::kDrag;
  field.damping_Ns_m = damping_Ns_m;
  return field;
}

Instance fieldsAt(std::uint64_t key, FieldList fields, const Motion& motion = Motion(Pose{})) {
  Instance instance = test::place(key, {}, motion);
  instance.fields = std::make_shared<const FieldList>(std::move(fields));
  return instance;
}
std::shared_ptr<const Snapshot> sceneOf(FieldList fields) { return makeSnapshot({fieldsAt(1, std::move(fields))}); }

TEST(FieldForces, AMagnetPullsMostAtAThirdOfItsReach) {
  const auto scene = sceneOf({magnet({Vec3::Zero()})});
  const auto at = [&](double x) { return fieldForces(*scene, {x, 0, 0}).force_N; };
  EXPECT_EQ(at(0), Vec3(Vec3::Zero()));
  EXPECT_LE((at(0.01) - Vec3(-2, 0, 0)).norm(), 1e-12);
  EXPECT_LE((at(-0.01) - Vec3(2, 0, 0)).norm(), 1e-12);
  for (double x = 1e-4; x < 0.03; x += 1e-4) {
    const double u = x / 0.03;
    EXPECT_NEAR(at(x).x(), -2 * 6.75 * u * (1 - u) * (1 - u), 1e-12);
    EXPECT_GE(at(x).x(), -2 - 1e-12);
  }
  EXPECT_NEAR(at(0.03 - 1e-9).x(), 0, 1e-9);
  EXPECT_EQ(at(0.03), Vec3(Vec3::Zero()));
  EXPECT_EQ(at(1), Vec3(Vec3::Zero()));
}

TEST(FieldForces, LinesAndPlanesPullAcrossAlone) {
  FieldSpec sheet = magnet({Vec3::Zero()});
  sheet.normal = Vec3::UnitY();
  const auto line = sceneOf({magnet({{-1, 0, 0}, {1, 0, 0}})}), plane = sceneOf({sheet});
  EXPECT_LE((fieldForces(*line, {0.3, 0.01, 0}).force_N - Vec3(0, -2, 0)).norm(), 1e-12);
  EXPECT_LE((fieldForces(*plane, {0.3, -0.01, 5}).force_N - Vec3(0, 2, 0)).norm(), 1e-12);
}

TEST(FieldForces, ASpringIsOfItsStiffnessUpToItsForce) {
  const auto scene = sceneOf({spring({0.1, 0, 0}, 0.05, 100, 2)});
  EXPECT_LE((fieldForces(*scene, {0.11, 0, 0}).force_N - Vec3(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LE((fieldForces(*scene, {0.1, 0.03, 0}).force_N - Vec3(0, -2, 0)).norm(), 1e-12);
  EXPECT_EQ(fieldForces(*scene, {0.1, 0.051, 0}).force_N, Vec3(Vec3::Zero()));
}

TEST(FieldForces, AConstantForceFallsToItsReach) {
  const auto scene = sceneOf({constant(Vec3::Zero(), 0.1, 3, Vec3::UnitZ())});
  EXPECT_EQ(fieldForces(*scene, Vec3::Zero()).force_N, Vec3(0, 0, 3));
  EXPECT_LE((fieldForces(*scene, {0.05, 0, 0}).force_N - Vec3(0, 0, 3 * 0.75 * 0.75)).norm(), 1e-12);
  EXPECT_EQ(fieldForces(*scene, {0.1, 0, 0}).force_N, Vec3(Vec3::Zero()));
}

TEST(FieldForces, DragsAddUpWithinTheirReach) {
  const auto scene = sceneOf({drag(Vec3::Zero(), 0.1, 2), drag({0.1, 0, 0}, 0.1, 3)});
  EXPECT_EQ(fieldForces(*scene, {0.05, 0, 0}).damping_Ns_m, 5);
  EXPECT_EQ(fieldForces(*scene, {-0.05, 0, 0}).damping_Ns_m, 2);
  EXPECT_EQ(fieldForces(*scene, {0.05, 0, 0}).force_N, Vec3(Vec3::Zero()));
}

// The work along closed ways, by the midpoints of short steps. A curve has its crease where two parts are as near.
TEST(FieldForces, MagnetsAndSpringsGiveNothingOnAClosedWay) {
  test::Random random(1);
  for (const FieldSpec& field : {magnet({Vec3::Zero()}), magnet({{-0.01, 0, 0}, {0.01, 0, 0}, {0.01, 0.02, 0}}),
                                 spring(Vec3::Zero(), 0.02, 300, 2), spring(Vec3::Zero(), 1, 1000, 1e3)}) {
    const auto scene = sceneOf({field});
    for (int way = 0; way < 20; ++way) {
      const Vec3 centre = random.inCube(0.02), u = 0.02 * random.direction(), v = 0.02 * random.direction();
      const int steps = test::cases(100'000);
      double work_J = 0;
      Vec3 before = centre + u;
      for (int i = 1; i <= steps; ++i) {
        const double angle = 2 * M_PI * i / steps;
        const Vec3 now = centre + std::cos(angle) * u + std::sin(angle) * v;
        work_J += fieldForces(*scene, 0.5 * (before + now)).force_N.dot(now - before);
        before = now;
      }
      EXPECT_NEAR(work_J, 0, 2e-6 * (100'000.0 / steps));
    }
  }
}

// From outside to the magnet: 9/16 of force times reach.
TEST(FieldForces, AMagnetGivesNoMoreThanItsDepth) {
  const auto scene = sceneOf({magnet({Vec3::Zero()})});
  double work_J = 0;
  for (int i = 0; i < 10'000; ++i)
    work_J -= fieldForces(*scene, {0.03 * (i + 0.5) / 10'000, 0, 0}).force_N.x() * 0.03 / 10'000;
  EXPECT_NEAR(work_J, 9.0 / 16 * 2 * 0.03, 1e-9);
}

TEST(FieldForces, MoveWithTheirObject) {
  constexpr std::int64_t kMs = 1'000'000;
  const Pose there{Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix(), Vec3(1, 0, 0)};
  const Motion motion = Motion(Pose{}).then(there, 0, 100 * kMs);
  const auto scene =
      makeSnapshot({fieldsAt(1, {magnet({{0, 0.1, 0}}), constant({0, 0.1, 0}, 0.1, 1, Vec3::UnitX())}, motion)});
  const FieldForces felt = fieldForces(SceneAt(*scene, 200 * kMs), {0.9, 0, 0.01});
  EXPECT_LE((felt.force_N - Vec3(0, 1 * std::pow(1 - 0.01, 2), -2)).norm(), 1e-9);
  ASSERT_EQ(felt.forces.size(), 2U);
  EXPECT_EQ(felt.forces[0].key, 1U);
  EXPECT_LE((felt.forces[0].point - Vec3(0.9, 0, 0)).norm(), 1e-12);
}

TEST(FieldForces, FourActAtOnceTheFirstOfTheScene) {
  FieldList fields(6, magnet({Vec3::Zero()}));
  const FieldForces felt = fieldForces(*sceneOf(fields), {0.01, 0, 0});
  EXPECT_EQ(felt.forces.size(), kMaxFieldsAtOnce);
  EXPECT_NEAR(felt.force_N.x(), -8, 1e-12);
}

TEST(FieldForces, TakeNoMemory) {
  test::Random random(2);
  FieldList fields;
  for (std::size_t i = 0; i < kMaxFields; ++i) fields.push_back(magnet({random.inCube(0.1), random.inCube(0.1)}));
  const auto scene = sceneOf(fields);
  double most_N = 0;
  const RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) most_N = std::max(most_N, fieldForces(*scene, random.inCube(0.1)).force_N.norm());
  EXPECT_GT(most_N, 1);
}

}  // namespace
}  // namespace hl::test_field_forces
