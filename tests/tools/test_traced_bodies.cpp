// Traces of scenes with bodies: where they are reported to be, against closed forms and against what the finger feels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/scene_model.h"
#include "tools/trace.h"

namespace hl::test_traced_bodies {
namespace {

constexpr double kStep_s = 1e-3;

Model cube(double half_m) {
  Model model;
  for (int i = 0; i < 8; ++i)
    model.positions.push_back(half_m * Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
  model.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return model;
}

// Far away, so that bodies have room.
Model twoPoints() {
  Model model;
  model.positions = {Vec3::Constant(-5), Vec3::Constant(5)};
  model.points = {0, 1};
  return model;
}

SceneBody bodyOfMass(double mass_kg, const Vec3& at, BodyShape shape) {
  SceneBody body;
  body.name = "it";
  body.model = cube(0.02);
  body.pose.origin = at;
  body.spec.mass_kg = mass_kg;
  body.spec.shape = shape;
  return body;
}

std::vector<TraceRow> rowsOf(const Snapshot& scene, const std::vector<PathSample>& path,
                             std::vector<TracedBody>& bodies) {
  std::vector<TraceRow> rows;
  runTrace(scene, {}, path, [&](const TraceRow& row) {
    rows.push_back(row);
    bodies.insert(bodies.end(), row.bodies.begin(), row.bodies.end());
  });
  return rows;
}

// R8.
TEST(TracedBodies, AThrownBallFliesOnAParabola) {
  SceneModel model(twoPoints());
  model.bodies.push_back(bodyOfMass(0.1, Vec3(0, 0.1, 0), BodyShape::kBall));
  const Vec3 velocity(0.5, 2, -0.3), spin(1, 2, 3);
  model.bodies[0].spec.velocity_m_s = velocity;
  model.bodies[0].spec.spin_rad_s = spin;
  const auto scene = makeSnapshot(std::move(model));
  std::vector<PathSample> path;
  for (int i = 0; i < 100; ++i) path.push_back({kStep_s * i, Vec3(0.5, 0, 0)});
  std::vector<TracedBody> ball;
  const std::vector<TraceRow> rows = rowsOf(*scene, path, ball);
  ASSERT_EQ(ball.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double t = rows[i].t;
    const Vec3 fall = Vec3(0, -9.81, 0) * t;
    EXPECT_LT((ball[i].origin - (Vec3(0, 0.1, 0) + velocity * t + fall * t / 2)).norm(), 1e-12) << i;
    EXPECT_LT((ball[i].velocity - (velocity + fall)).norm(), 1e-12) << i;
    EXPECT_LT((ball[i].spin - spin).norm(), 1e-12) << i;
    EXPECT_NEAR(std::abs(ball[i].turned.w()), std::cos(spin.norm() * t / 2), 1e-12) << i;
    const double change_J =
        rows[i].world.kinetic_J + rows[i].world.gravity_J - rows[0].world.kinetic_J - rows[0].world.gravity_J;
    EXPECT_NEAR(change_J, rows[i].world.book.solver_J, 1e-12);
  }
}

// The finger hits the block and goes back: what it felt is the momentum that the block has then.
TEST(TracedBodies, GetTheMomentumThatTheFingerFeels) {
  SceneModel model(twoPoints());
  constexpr double kMass_kg = 0.1;
  model.bodies.push_back(bodyOfMass(kMass_kg, Vec3::Zero(), BodyShape::kBox));
  model.mechanics.gravity_m_s2.setZero();
  const auto scene = makeSnapshot(std::move(model));
  std::vector<PathSample> path;
  for (int i = 0; i < 1200; ++i) {
    const double x = i < 200 ? -0.04 + 1e-4 * i : std::max(-0.02 - 1e-4 * (i - 200), -0.06);
    path.push_back({kStep_s * i, Vec3(x, 0, 0)});
  }
  std::vector<TracedBody> block;
  const std::vector<TraceRow> rows = rowsOf(*scene, path, block);
  Vec3 felt_N_s = Vec3::Zero();
  for (const TraceRow& row : rows) felt_N_s += kStep_s * row.force;
  EXPECT_LT(felt_N_s.x(), -1e-3) << "nothing was hit";
  EXPECT_LT((felt_N_s + kMass_kg * block.back().velocity).norm(), 1e-12);
  EXPECT_NEAR(rows.back().world.kinetic_J, rows.back().world.book.by_hand_J + rows.back().world.book.solver_J, 1e-12);
}

// It falls out of its room again and again, and is put back.
TEST(TracedBodies, TheEnergyBookClosesAlsoWhereABodyIsPutBack) {
  SceneModel model;
  model.bodies.push_back(bodyOfMass(0.1, Vec3(0, 0.1, 0), BodyShape::kBox));
  const auto scene = makeSnapshot(std::move(model));
  std::vector<PathSample> path;
  for (int i = 0; i < 1000; ++i) path.push_back({kStep_s * i, Vec3(0.5, 0, 0)});
  const TraceTotals totals = runTrace(*scene, {}, path, [](const TraceRow& row) {
    EXPECT_NEAR(row.world.kinetic_J + row.world.gravity_J, 0.1 * 9.81 * 0.1 + row.world.book.solver_J, 1e-12);
  });
  EXPECT_GT(totals.returned, 3U);
}

// A pendulum with a spring and a damper: its angle is that of its pose, and the book closes in every row.
TEST(TracedBodies, JointsHaveTheirCoordinateAndCloseTheBook) {
  SceneModel model(twoPoints());
  model.bodies.push_back(bodyOfMass(0.1, Vec3(0.1, 0, 0), BodyShape::kBox));
  constexpr std::uint64_t kBody = 1;
  JointSpec hinge;
  hinge.name = "hinge";
  hinge.kind = JointKind::kHinge;
  hinge.body_a = kBody;
  hinge.axis_W = Vec3::UnitZ();
  hinge.along.spring = 0.02;
  hinge.along.damping = 1e-3;
  model.mechanics.joints = {hinge, {"pin", JointKind::kBall, kBody, 0, Vec3::Zero(), {}, Vec3::UnitX(), {}}};
  const auto scene = makeSnapshot(std::move(model));
  EXPECT_EQ(tracedJoints(*scene), (std::vector<std::string>{"hinge"})) << "the other has no coordinate";
  std::vector<PathSample> path;
  for (int i = 0; i < 500; ++i) path.push_back({kStep_s * i, Vec3(0.5, 0, 0)});
  double begin_J = 0, least = 0;
  const auto energy_J = [](const TraceRow& row) {
    const TracedWorld& world = row.world;
    return world.kinetic_J + world.gravity_J + world.spring_J - world.book.change_J();
  };
  runTrace(*scene, {}, path, [&](const TraceRow& row) {
    ASSERT_EQ(row.joints.size(), 1u);
    const TracedJoint& joint = row.joints[0];
    if (row.t == 0) begin_J = energy_J(row);
    EXPECT_NEAR(energy_J(row), begin_J, 1e-12) << row.t;
    const Vec3 arm = row.bodies[0].turned * Vec3::UnitX();
    EXPECT_NEAR(joint.coordinate, std::atan2(arm.y(), arm.x()), 1e-9) << row.t;
    least = std::min(least, joint.coordinate);
    // That of spring and damper in the middle of the step, to first order in it.
    EXPECT_NEAR(joint.force, -hinge.along.spring * joint.coordinate - hinge.along.damping * joint.velocity, 2e-3);
  });
  EXPECT_LT(least, -0.5) << "it fell";
}

TEST(TracedBodies, AreTheSameInEachRunAndNoneWithoutBodies) {
  SceneModel model;
  model.model = cube(0.02);
  model.bodies.push_back(bodyOfMass(0.1, Vec3(0, 0.041, 0), BodyShape::kBox));
  const auto scene = makeSnapshot(std::move(model));
  std::vector<PathSample> path;
  for (int i = 0; i < 300; ++i) path.push_back({kStep_s * i, Vec3(-0.04 + 2e-4 * i, 0.04, 0)});
  std::vector<TracedBody> bodies, again;
  const auto first = rowsOf(*scene, path, bodies), second = rowsOf(*scene, path, again);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].world.hash, second[i].world.hash) << i;
  EXPECT_NE(first[1].world.hash, first[299].world.hash);
  EXPECT_EQ(tracedBodies(*scene), std::vector<std::string>{"it"});
  std::vector<TracedBody> none;
  rowsOf(*makeSnapshot(cube(0.02)), path, none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace hl::test_traced_bodies
