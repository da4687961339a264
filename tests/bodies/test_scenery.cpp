// Scenery that its client moves: it pushes, lifts and takes along bodies, and its work is booked as the client's.
#include "bodies/scenery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bodies/draws.h"
#include "bodies/test_worlds.h"

namespace hl::test_scenery {
namespace {

constexpr std::int64_t kStep_ns = 1'000'000;

// From `from` on, evenly to `to` in `seconds`.
Motion motionOf(const Pose& from, const Pose& to, double seconds) {
  return Motion(from).then(to, 0, std::llround(1e9 * seconds));
}

Motion slideBy(const Vec3& from, const Vec3& velocity, double seconds) {
  return motionOf({Mat3::Identity(), from}, {Mat3::Identity(), from + seconds * velocity}, seconds);
}

// Bodies among moving scenery; the energy book is checked in each step.
class Stage {
 public:
  Stage(std::vector<Instance> scenery, std::vector<Body> bodies, const std::vector<Vec3>& places,
        double gravity = test::kGravity, const BodySurface& of_last = {0.5, 0.5, 0}) {
    World world;
    world.bodies = std::move(bodies);
    world.fixed_surfaces.resize(scenery.size());
    world.fixed_surfaces.back() = of_last;
    world.fixed = makeSnapshot(std::move(scenery));
    world.gravity_m_s2 = Vec3(0, -gravity, 0);
    std::vector<Pose> poses;
    for (const Vec3& place : places) poses.push_back(test::placeAt(place));
    play_.emplace(std::move(world), poses);
  }

  void steps(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += test::kStep_s) step();
  }
  BodyStepReport step() {
    const double before_J = play_->energy_J();
    const EnergyBook book = play_->state.energy;
    const BodyStepReport report =
        play_->stepper.step(play_->state, test::kStep_s, {}, {}, {time_ns_, time_ns_ + kStep_ns});
    time_ns_ += kStep_ns;
    const EnergyBook& now = play_->state.energy;
    const double booked_J = now.by_client_J - book.by_client_J - (now.contact_J - book.contact_J) -
                            (now.friction_J - book.friction_J) + now.solver_J - book.solver_J;
    EXPECT_NEAR(play_->energy_J() - before_J, booked_J, 1e-12 + 1e-9 * std::abs(booked_J));
    deepest_ = std::max(deepest_, report.deepest);
    return report;
  }
  const BodyState& body(std::size_t i = 0) const { return play_->state.bodies[i]; }
  const EnergyBook& book() const { return play_->state.energy; }
  double deepest() const { return deepest_; }

 private:
  std::optional<test::Playground> play_;
  std::int64_t time_ns_ = 0;
  double deepest_ = 0;
};

TEST(Scenery, AFloorThatRisesLiftsWhatStandsOnItAndPaysForIt) {
  constexpr double kMass_kg = 0.1, kSpeed_m_s = 0.2, kTime_s = 0.5;
  Stage stage({test::instanceOf(test::boxModel(Vec3(0.1, 0.01, 0.1)), 1,
                                slideBy(Vec3(0, -0.01, 0), Vec3(0, kSpeed_m_s, 0), kTime_s))},
              {test::block(1, kMass_kg, Vec3::Constant(0.02), 0.5)}, {Vec3(0, 0.02, 0)});
  stage.steps(kTime_s / 2);
  EXPECT_NEAR(stage.body().velocity.y(), kSpeed_m_s, 1e-9);
  const double before_J = stage.book().by_client_J;
  stage.steps(kTime_s / 4);
  EXPECT_NEAR(stage.book().by_client_J - before_J, kMass_kg * test::kGravity * kSpeed_m_s * kTime_s / 4, 1e-7);
  EXPECT_LT(stage.deepest(), 1e-6);
}

TEST(Scenery, AWallPushesABlockOverAFloorAgainstItsFriction) {
  constexpr double kMass_kg = 0.1, kFriction = 0.4, kSpeed_m_s = 0.05;
  Stage stage({test::instanceOf(test::floorScene()->shape().model, 1),
               test::instanceOf(test::boxModel(Vec3(0.01, 0.1, 0.1)), 2,
                                slideBy(Vec3(-0.031, 0, 0), Vec3(kSpeed_m_s, 0, 0), 1))},
              {test::block(1, kMass_kg, Vec3::Constant(0.02), kFriction)}, {Vec3(0, 0.02, 0)}, test::kGravity,
              {0, 0, 0});
  stage.steps(0.4);
  EXPECT_NEAR(stage.body().velocity.x(), kSpeed_m_s, 1e-7);
  const double before_J = stage.book().by_client_J, friction_J = stage.book().friction_J;
  stage.steps(0.5);
  const double work_J = kFriction * kMass_kg * test::kGravity * kSpeed_m_s * 0.5;
  EXPECT_NEAR(stage.book().by_client_J - before_J, work_J, 1e-4 * work_J);
  EXPECT_NEAR(stage.book().friction_J - friction_J, work_J, 1e-4 * work_J);
  EXPECT_LT(stage.deepest(), 1e-6);
}

TEST(Scenery, ABeltTakesABlockAlongByItsFriction) {
  constexpr double kFriction = 0.3, kSpeed_m_s = 0.3;
  Stage stage(
      {test::instanceOf(test::boxModel(Vec3(1, 0.01, 0.1)), 1, slideBy(Vec3(0, -0.01, 0), Vec3(kSpeed_m_s, 0, 0), 1))},
      {test::block(1, 0.1, Vec3(0.02, 0.005, 0.02), kFriction)}, {Vec3(0, 0.005, 0)}, test::kGravity,
      {kFriction, kFriction, 0});
  const double slips_s = kSpeed_m_s / (kFriction * test::kGravity);  // 0.102 s
  stage.steps(0.05);
  EXPECT_NEAR(stage.body().velocity.x(), kFriction * test::kGravity * 0.05, 2e-3 * kSpeed_m_s);
  stage.steps(1.2 * slips_s - 0.05);
  EXPECT_NEAR(stage.body().velocity.x(), kSpeed_m_s, 1e-9);
}

// A paddle of 2 mm turns by up to 20 rad/s through balls that float: none is in it or behind it afterwards.
TEST(Scenery, APaddleThatTurnsPassesNoBall) {
  std::mt19937_64 random(5);
  for (int run = 0; run < 40; ++run) {
    const double turn_rad = std::uniform_real_distribution<double>(0.2, 2)(random);
    const Mat3 turned = Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()).toRotationMatrix();
    const double radius_m = 0.01;
    Stage stage({test::instanceOf(test::boxModel(Vec3(0.1, 0.001, 0.1)), 1, motionOf({}, {turned, Vec3::Zero()}, 0.1))},
                {test::ball(1, 0.01, radius_m, 0.3)},
                {Vec3(std::uniform_real_distribution<double>(0.03, 0.08)(random), 0.0111, 0)}, 0);
    const Motion motion = motionOf({}, {turned, Vec3::Zero()}, 0.1);
    for (int ms = 1; ms <= 100; ++ms) {
      stage.step();
      const Vec3 in_paddle = motion.at(ms * kStep_ns).toObject(stage.body().centre);
      if (std::abs(in_paddle.x()) < 0.1) {
        ASSERT_GT(in_paddle.y(), radius_m + 0.001 - 2e-5) << run << " at " << ms;
      } else {
        break;  // it has rolled over the end
      }
    }
    EXPECT_GT(stage.body().velocity.norm(), 0.05) << run;
    EXPECT_LT(stage.deepest(), 1e-4) << run;
  }
}

TEST(Scenery, NoPointIsFasterThanTheFastest) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const auto pose = [&] {
      const Vec3 axis = Vec3(any(random), any(random), any(random)).normalized();
      return Pose{Eigen::AngleAxisd(3 * any(random), axis).toRotationMatrix(),
                  Vec3(any(random), any(random), any(random))};
    };
    const Instance box = test::instanceOf(test::boxModel(Vec3(0.1, 0.2, 0.3)), 1, motionOf(pose(), pose(), 0.1));
    const double most = fastestScenery_m_s(*makeSnapshot({box}));
    const StepTimes times{40 * kStep_ns, 41 * kStep_ns};
    for (const Vec3& corner : box.shape->model.positions) {
      const Vec3 point = box.poses().at(times.begin_ns).toWorld(corner);
      ASSERT_LE(sceneryVelocity(box, times, test::kStep_s, point).norm(), most) << i;
    }
  }
}

// A ground of 80 000 triangles, 1000 and more of them under each body: it lands, lies still, and no contact is lost.
TEST(Scenery, BodiesLieOnGroundsOfManyTriangles) {
  using namespace test;
  constexpr std::uint32_t kCells = 200;
  for (const double rough_m : {0.0, 5e-5}) {
    Draws draws(7);
    Model ground;
    for (std::uint32_t j = 0; j <= kCells; ++j) {
      for (std::uint32_t i = 0; i <= kCells; ++i)
        ground.positions.emplace_back(5e-4 * i - 0.05, draws.between(-1, 0) * rough_m, 5e-4 * j - 0.05);
    }
    for (std::uint32_t j = 0; j < kCells; ++j) {
      for (std::uint32_t i = 0; i < kCells; ++i) {
        const std::uint32_t a = j * (kCells + 1) + i, b = a + kCells + 1;
        ground.triangles.push_back({a, b, a + 1});
        ground.triangles.push_back({a + 1, b, b + 1});
      }
    }
    World world;
    world.fixed = makeSnapshot(ground);
    const Vec3 half(0.01, 0.008, 0.012);
    world.bodies.push_back({1, massOfBox(0.1, half), boxShape(half), {0.5, 0.5, 0}});
    world.bodies.push_back({2, massOfCylinder(0.1, 0.01, 0.009), cylinderShape(0.01, 0.009), {0.5, 0.5, 0}});
    world.bodies.push_back({3, massOfBall(0.1, 0.01), ballShape(0.01), {0.5, 0.5, 0}});
    Playground play(world, {placeAt({-0.03, 0.03, 0}, Mat3::Identity()),
                            placeAt({0, 0.03, 0.001}, Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()).toRotationMatrix()),
                            placeAt({0.03, 0.03, 0}, Mat3::Identity())});
    for (int step = 0; step < 600; ++step) ASSERT_EQ(play.step().dropped, 0U);
    const double heights[] = {half.y(), 0.01, 0.01};
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(play.state.bodies[i].centre.y(), heights[i], rough_m + 2e-5) << i << " roughness " << rough_m;
    EXPECT_LT(play.state.bodies[0].velocity.norm(), 1e-3) << rough_m;
  }
}

}  // namespace
}  // namespace hl::test_scenery
