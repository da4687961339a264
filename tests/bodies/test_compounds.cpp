// Bodies of several parts: what is hollow is hollow, and what has a hook hangs.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies/mesh_body.h"
#include "bodies/world_hash.h"
#include "draws.h"
#include "guard/realtime_guard.h"
#include "mesh_drawings.h"

namespace hl::test_compounds {
namespace {

using namespace test;

Body bodyOfParts(std::uint64_t key, const Model& model, double mass_kg, double friction) {
  BodySpec spec;
  spec.shape = BodyShape::kParts;
  spec.mass_kg = mass_kg;
  spec.surface = {friction, friction, 0};
  Body body = bodyOf(model, spec);
  body.key = key;
  return body;
}

std::shared_ptr<const Snapshot> floorAnd(Model other) {
  Model model = floorScene()->shape().model;
  addMesh(model, other);
  return makeSnapshot(std::move(model));
}

double deepestOf(Playground& play, int steps) {
  double deepest = 0;
  for (int i = 0; i < steps; ++i) deepest = std::max(deepest, play.step().deepest);
  return deepest;
}

// A ring of 20 mm inside lies around a square peg of 10 mm; gravity along the floor pulls it away. It stays.
TEST(Compounds, ARingDoesNotLeaveItsPeg) {
  for (const double turn : {0.0, 0.3, 2.0}) {
    World world;
    world.fixed = floorAnd(boxesModel({{Vec3(0.005, 0.03, 0.005), Vec3(0, 0.03, 0)}}));
    world.gravity_m_s2 = Vec3(3, -9.81, 0);
    world.bodies = {bodyOfParts(1, ringModel(0.01, 0.015, 0.004, 16), 0.05, 0.1)};
    Playground play(std::move(world), {placeAt(Vec3(0, 0.004, 0), Eigen::AngleAxisd(turn, Vec3::UnitY()).matrix())});
    EXPECT_LT(deepestOf(play, 2000), 2e-5);  // 1.5e-5 seen, while it swings along the peg
    const BodyState& body = play.state.bodies[0];
    // Where two corners of the peg are on the inner circle, or on the chords of 16 of it.
    EXPECT_GT(body.centre.x(), std::sqrt(0.0098 * 0.0098 - 0.005 * 0.005) - 0.005);
    EXPECT_LT(body.centre.x(), std::sqrt(0.01 * 0.01 - 0.005 * 0.005) - 0.005);
    EXPECT_NEAR(body.centre.y(), 0.004, 1e-6);
    EXPECT_LT(body.velocity.norm() + 0.015 * body.spin.norm(), 1e-3);
  }
}

// Dropped from above the peg, it falls down along it to the floor.
TEST(Compounds, ARingFallsOverAPeg) {
  World world;
  world.fixed = floorAnd(boxesModel({{Vec3(0.005, 0.03, 0.005), Vec3(0, 0.03, 0)}}));
  world.bodies = {bodyOfParts(1, ringModel(0.01, 0.015, 0.004, 16), 0.05, 0.1)};
  Playground play(std::move(world), {placeAt(Vec3(0.001, 0.1, 0))});
  EXPECT_LT(deepestOf(play, 1000), 1e-5);
  EXPECT_NEAR(play.state.bodies[0].centre.y(), 0.004, 1e-6);
}

// As one closed mesh, which is cut into parts: a doughnut falls over a peg and lies around it.
TEST(Compounds, ADoughnutFallsOverAPeg) {
  World world;
  world.fixed = floorAnd(boxesModel({{Vec3(0.004, 0.03, 0.004), Vec3(0, 0.03, 0)}}));
  world.bodies = {bodyOfParts(1, torusModel(0.012, 0.004, 24, 12), 0.05, 0.1)};
  ASSERT_GT(world.bodies[0].shape.parts.size(), 4u);
  Playground play(std::move(world), {placeAt(Vec3(0.001, 0.1, 0))});
  EXPECT_LT(deepestOf(play, 2000), 1e-5);
  EXPECT_NEAR(play.state.bodies[0].centre.y(), 0.004, 1e-4);
  EXPECT_LT(play.state.bodies[0].centre.head<1>().norm(), 0.008);
}

// A round beaker of one closed mesh: the ball lies in it, above its bottom.
TEST(Compounds, ABeakerCatchesABall) {
  constexpr double kBall_m = 0.008, kThick_m = 0.003;
  World world;
  world.fixed = floorScene();
  world.bodies = {bodyOfParts(1, beakerModel(0.02, 0.04, kThick_m, 24), 0.05, 0.5), ball(2, 0.02, kBall_m, 0.3)};
  Playground play(std::move(world), {placeAt(Vec3::Zero()), placeAt(Vec3(0.004, 0.15, -0.003))});
  EXPECT_LT(deepestOf(play, 4000), 1e-5);
  const BodyState &cup = play.state.bodies[0], &caught = play.state.bodies[1];
  EXPECT_NEAR(caught.centre.y(), kThick_m + kBall_m, 1e-3);
  EXPECT_LT(std::hypot(caught.centre.x() - cup.centre.x(), caught.centre.z() - cup.centre.z()), 0.011);
}

// The cup stands on the floor, and the ball in the cup: the floor bears both, the cup's bottom the ball.
TEST(Compounds, ACupCatchesABall) {
  constexpr double kBall_m = 0.008, kThick_m = 0.002;
  World world;
  world.fixed = floorScene();
  world.bodies = {bodyOfParts(1, cupModel(0.02, 0.04, kThick_m), 0.05, 0.5), ball(2, 0.02, kBall_m, 0.3)};
  const double centre_y = world.bodies[0].mass.centre_O.y();
  Playground play(std::move(world), {placeAt(Vec3::Zero()), placeAt(Vec3(0.004, 0.15, -0.003))});
  EXPECT_LT(deepestOf(play, 3000), 1e-5);
  const BodyState &cup = play.state.bodies[0], &caught = play.state.bodies[1];
  EXPECT_NEAR(cup.centre.y(), centre_y, 1e-6);
  EXPECT_NEAR(caught.centre.y(), kThick_m + kBall_m, 1e-6);
  EXPECT_LT(std::abs(caught.centre.x() - cup.centre.x()), 0.02 - kThick_m - kBall_m + 1e-6);
}

// A cup that is carried away takes the ball along.
TEST(Compounds, ACupCarriesItsBall) {
  World world;
  world.gravity_m_s2.setZero();
  world.bodies = {bodyOfParts(1, cupModel(0.02, 0.04, 0.002), 0.05, 0), ball(2, 0.02, 0.008, 0)};
  Playground play(std::move(world), {placeAt(Vec3::Zero()), placeAt(Vec3(0, 0.012, 0))});
  play.state.bodies[0].velocity = Vec3(0.5, 0, 0);
  const Vec3 momentum = play.momentum();
  EXPECT_LT(deepestOf(play, 1000), 1e-5);
  EXPECT_LT((play.momentum() - momentum).norm(), 1e-12);
  const double apart = play.state.bodies[1].centre.x() - play.state.bodies[0].centre.x();
  EXPECT_LT(std::abs(apart), 0.0101);
  EXPECT_GT(play.state.bodies[1].velocity.x(), 0.2);
}

// An L hangs with its short side over the edge of a shelf; its centre of mass is beneath, and so it stays.
TEST(Compounds, AnLHangsOnAnEdge) {
  constexpr double kThick = 0.004, kLong = 0.06, kShort = 0.02;
  World world;
  world.fixed = makeSnapshot(boxesModel({{Vec3(0.05, 0.002, 0.05), Vec3(-0.05, -0.002, 0)}}));
  // The long side hangs down beside the shelf, the short one lies on it.
  world.bodies = {bodyOfParts(1,
                              boxesModel({{Vec3(kThick, kLong, 0.02) / 2, Vec3(kThick / 2, kThick - kLong / 2, 0)},
                                          {Vec3(kShort, kThick, 0.02) / 2, Vec3(-kShort / 2, kThick / 2, 0)}}),
                              0.05, 0.5)};
  ASSERT_EQ(world.bodies[0].shape.parts.size(), 2u);
  Playground play(std::move(world), {placeAt(Vec3(1e-4, 1e-4, 0))});
  EXPECT_LT(deepestOf(play, 4000), 1e-5);
  const Pose pose = poseOf(play.world->bodies[0], play.state.bodies[0]);
  EXPECT_LT(pose.origin.norm(), 2e-3);
  EXPECT_GT(pose.rotation(1, 1), 0.99);
  EXPECT_LT(play.state.bodies[0].velocity.norm(), 1e-3);
}

// What is nothing but a box, drawn as one or as two halves: it slides over the floor and stops at the same place.
TEST(Compounds, TwoHalvesSlideAsOneBox) {
  const Vec3 half(0.02, 0.01, 0.015);
  const Vec3 part(0.01, 0.01, 0.015);
  World world;
  world.fixed = floorScene();
  const Body whole = block(1, 0.1, half, 0.3);
  world.bodies = {whole, bodyOfParts(2, boxesModel({{part, Vec3(-0.01, 0, 0)}, {part, Vec3(0.01, 0, 0)}}), 0.1, 0.3)};
  ASSERT_EQ(world.bodies[1].shape.parts.size(), 2u);
  EXPECT_LT((world.bodies[1].mass.inertia_kg_m2 - whole.mass.inertia_kg_m2).norm(), 1e-15);
  Playground play(std::move(world), {placeAt(Vec3(0, 0.01, -0.1)), placeAt(Vec3(0, 0.01, 0.1))});
  for (BodyState& body : play.state.bodies) body.velocity = Vec3(0.5, 0, 0);
  play.steps(1000);
  const double way = 0.5 * 0.5 / (2 * 0.3 * kGravity);
  for (const BodyState& body : play.state.bodies) {
    EXPECT_NEAR(body.centre.x(), way, 3e-4);
    EXPECT_NEAR(body.centre.y(), 0.01, 1e-6);
    EXPECT_LT(body.velocity.norm(), 1e-9);
  }
  EXPECT_NEAR(play.state.bodies[0].centre.x(), play.state.bodies[1].centre.x(), 1e-6);
}

// A block slides from one half of a table onto the other: the seam does not stop it.
TEST(Compounds, ASeamIsNotFelt) {
  const Vec3 part(0.1, 0.01, 0.05);
  World world;
  world.bodies = {bodyOfParts(1, boxesModel({{part, Vec3(-0.1, 0, 0)}, {part, Vec3(0.1, 0, 0)}}), 1e6, 0),
                  block(2, 0.1, Vec3::Constant(0.01), 0)};
  world.gravity_m_s2.setZero();
  Playground play(std::move(world), {placeAt(Vec3::Zero()), placeAt(Vec3(-0.08, 0.02, 0))});
  play.state.bodies[1].velocity = Vec3(0.2, -1e-3, 0);
  play.steps(800);
  EXPECT_NEAR(play.state.bodies[1].velocity.x(), 0.2, 1e-9);
  EXPECT_NEAR(play.state.bodies[1].centre.x(), 0.08, 1e-6);
}

// The finger is inside the cup, and hits its wall: the cup gets all that it feels.
TEST(Compounds, AFingerInsideACupPushesItsWall) {
  World world;
  world.gravity_m_s2.setZero();
  world.bodies = {bodyOfParts(1, cupModel(0.02, 0.04, 0.002), 0.05, 0)};
  const double centre_y = world.bodies[0].mass.centre_O.y();
  Playground play(std::move(world), {placeAt(Vec3::Zero())});
  Pusher pusher;
  pusher.finger = pusher.proxy = Vec3(0, centre_y, 0);
  Vec3 given = Vec3::Zero();
  for (int i = 0; i < 400; ++i) {
    pusher.finger.x() += 1e-4;
    const std::array hands{pusher.node()};
    play.step(hands);
    pusher.tick(play.state.bodies[0].centre.x() + 0.018, kStep_s, play.given[0]);
    for (const BodyImpulse& one : play.given[0]) given += one.impulse_N_s;
  }
  EXPECT_LT((play.momentum() - given).norm(), 1e-12);
  const double away = 0.1 * (1 + std::exp(-EIGEN_PI / 2 * std::sqrt(pusher.spring_N_m / 0.05) * kStep_s));
  EXPECT_NEAR(play.state.bodies[0].velocity.x(), away, 0.01 * away) << "as R4";
}

// Some rings, cups and Ls over a floor with a peg.
World jumble(std::vector<Pose>& poses) {
  World world;
  world.fixed = floorAnd(boxesModel({{Vec3(0.005, 0.03, 0.005), Vec3(0, 0.03, 0)}}));
  Draws draws(3);
  for (std::uint64_t key = 1; key <= 9; ++key) {
    const Model model = key % 3 == 0   ? ringModel(0.01, 0.015, 0.004, 12)
                        : key % 3 == 1 ? cupModel(0.012, 0.02, 0.003)
                                       : boxesModel({{Vec3(0.003, 0.012, 0.005), Vec3(0.003, 0, 0)},
                                                     {Vec3(0.008, 0.003, 0.005), Vec3(0.014, -0.009, 0)}});
    world.bodies.push_back(bodyOfParts(key, model, draws.between(0.01, 0.1), 0.4));
    poses.push_back(placeAt(Vec3(0.01 * static_cast<double>(key % 2), 0.03 + 0.04 * static_cast<double>(key), 0),
                            Eigen::AngleAxisd(draws.between(0, 3), draws.direction()).toRotationMatrix()));
  }
  return world;
}

TEST(Compounds, AStepAllocatesNothing) {
  std::vector<Pose> poses;
  World world = jumble(poses);
  Playground play(std::move(world), poses);
  play.step();
  std::size_t dropped = 0;
  {
    const RealtimeGuard guard;
    for (int i = 0; i < 600; ++i) dropped += play.step().dropped;
  }
  EXPECT_EQ(dropped, 0u);
}

TEST(Compounds, GoToSleepAndWakeWhenTheyAreHit) {
  World world;
  world.fixed = floorScene();
  world.bodies = {bodyOfParts(1, cupModel(0.02, 0.04, 0.002), 0.05, 0.5), ball(2, 0.02, 0.008, 0.3)};
  Playground play(std::move(world), {placeAt(Vec3::Zero()), placeAt(Vec3(0, 2, 0))});
  play.steps(600);
  EXPECT_NE(play.state.bodies[0].island, 0u);
  bool woke = false;
  for (int i = 0; i < 400; ++i) {
    play.step();
    woke |= play.state.bodies[0].island == 0;
  }
  EXPECT_TRUE(woke);
  EXPECT_NEAR(play.state.bodies[1].centre.y(), 0.01, 1e-4);
}

// A state that is taken up in another stepper goes on to the bit.
TEST(Compounds, GoOnFromAStateToTheBit) {
  std::vector<Pose> poses;
  Playground play(jumble(poses), poses);
  play.steps(300);
  Playground other(*play.world, poses);
  other.state = play.state;
  for (int i = 0; i < 200; ++i) {
    play.step();
    other.step();
    ASSERT_EQ(hashOf(*play.world, play.state), hashOf(*other.world, other.state)) << i;
  }
}

// Two cubes that share an edge, which is the z axis. Its centre of mass lies there too.
Body cubesAtAnEdge(double half_m, double friction) {
  const Vec3 half = Vec3::Constant(half_m);
  return bodyOfParts(1, boxesModel({{half, Vec3(-half_m, -half_m, 0)}, {half, Vec3(half_m, half_m, 0)}}), 0.1,
                     friction);
}

// A contact at the edge could bear all of it, and it would spin there for ever.
TEST(Compounds, CubesThatShareAnEdgeComeToRest) {
  for (int seed = 0; seed < 6; ++seed) {
    Draws draws(static_cast<std::uint64_t>(seed));
    World world;
    world.fixed = floorScene();
    world.bodies = {cubesAtAnEdge(0.005, 0.5)};
    const Mat3 turned = Eigen::AngleAxisd(draws.between(0, 3), draws.direction()).toRotationMatrix();
    Playground play(std::move(world), {placeAt(Vec3(0, 0.1, 0), turned)});
    play.steps(3000);
    EXPECT_EQ(play.stepper.awake().size(), 0u) << seed << " spins at " << play.state.bodies[0].spin.norm();
  }
}

// Of the contacts in its plane none lies between others, so that the friction at its corners stops it.
TEST(Compounds, TheCornersBearWhatStandsOnAFace) {
  constexpr double kHalf_m = 0.02;
  World world;
  world.fixed = floorScene();
  world.bodies = {cubesAtAnEdge(kHalf_m, 0.5)};
  const Mat3 upright = Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitX()).toRotationMatrix();
  Playground play(std::move(world), {placeAt(Vec3(0.1, kHalf_m, 0.05), upright)});
  play.steps(10);
  for (const Row& row : play.stepper.rows())
    EXPECT_GT(std::hypot(row.arm_a.x(), row.arm_a.z()), kHalf_m) << row.arm_a.transpose();
  play.state.bodies[0].spin.y() = 5;
  play.steps(100);
  EXPECT_LT(play.state.bodies[0].spin.norm(), 1e-9);
}

}  // namespace
}  // namespace hl::test_compounds
