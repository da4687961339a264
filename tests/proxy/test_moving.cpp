// Moving objects against a proxy: nothing passes through it, at any speed and however late the tick.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "judge.h"
#include "moving_scenes.h"
#include "proxy/proxy.h"

namespace hl::test_moving {
namespace {

constexpr double kRadius = 0.002;
constexpr std::int64_t kMs = 1'000'000;

ProxySettings settingsOf(double static_friction = 0, double dynamic_friction = 0) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.surfaces.static_friction = static_friction;
  settings.surfaces.dynamic_friction = dynamic_friction;
  return settings;
}

using test::at, test::boxModel, test::place, test::rectangle, test::turned;

// M1. A plate runs at the speed given into a finger that is held still, goes on for 60 mm, and comes back.
TEST(Moving, APlateNeverPassesAHeldFinger) {
  for (const double speed : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    for (const std::int64_t period : {kMs / 4, kMs, 33 * kMs}) {
      const auto way_ns = static_cast<std::int64_t>(0.08 / speed * 1e9);
      const Model plate = rectangle({-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1});
      const Motion motion =
          Motion(at({0, -0.02, 0})).then(at({0, 0.06, 0}), 0, way_ns).then(at({0, -0.02, 0}), way_ns, 2 * way_ns);
      const auto snapshot = makeSnapshot({place(1, plate, motion)});
      const Vec3 finger(0.01, 0, 0.02);
      ProxyState state = startProxy({*snapshot, 0}, settingsOf(), finger);
      for (std::int64_t t = period; t < 2 * way_ns + 2 * period; t += period) {
        tick(state, {*snapshot, t}, settingsOf(), finger);
        const double height = state.position.y() - motion.at(t).origin.y();
        ASSERT_GE(height, kRadius * (1 - 1e-9)) << speed << " m/s, " << period << " ns";
        if (motion.at(t).origin.y() > -kRadius) {
          ASSERT_NEAR(height, kRadius, 1e-8);
        }
      }
      EXPECT_EQ(state.position, finger) << "the plate has gone";
    }
  }
}

// The same with a plate that is a line, and one that is a point, aimed at the middle of the proxy.
TEST(Moving, LinesAndPointsPushToo) {
  for (const double speed : {0.1, 10.0}) {
    Model line, point;
    line.positions = {{-1, 0, 0}, {1, 0, 0}};
    line.segments = {{0, 1}};
    point.positions = {{0, 0, 0}};
    point.points = {0};
    for (const Model& model : {line, point}) {
      const auto way_ns = static_cast<std::int64_t>(0.04 / speed * 1e9);
      const Motion motion = Motion(at({0, -0.02, 0})).then(at({0, 0.02, 0}), 0, way_ns);
      const auto snapshot = makeSnapshot({place(1, model, motion)});
      ProxyState state = startProxy({*snapshot, 0}, settingsOf(), Vec3::Zero());
      bool pushed = false;
      for (std::int64_t t = kMs / 2; t < way_ns; t += kMs / 2) {
        tick(state, {*snapshot, t}, settingsOf(), Vec3::Zero());
        EXPECT_GE((state.position - motion.at(t).origin).norm(), kRadius * (1 - 1e-9));
        pushed |= state.position.norm() > 0.5 * kRadius;
      }
      EXPECT_TRUE(pushed);
    }
  }
}

// M2. A paddle hinged at the origin sweeps through 120 degrees; the finger waits in its way.
TEST(Moving, APaddleNeverPassesAHeldFinger) {
  for (const double rate : {0.1, 1.0, 10.0, 100.0}) {
    for (const std::int64_t period : {kMs, 10 * kMs}) {
      const auto way_ns = static_cast<std::int64_t>(2 * M_PI / 3 / rate * 1e9);
      const Model paddle = rectangle({0, 0, 0.3}, {0.5, 0, 0}, {0, 0, -0.6});
      const Motion motion = Motion(turned(-M_PI / 3, Vec3::UnitZ())).then(turned(M_PI / 3, Vec3::UnitZ()), 0, way_ns);
      const auto snapshot = makeSnapshot({place(1, paddle, motion)});
      const Vec3 finger(0.06, 0, 0);
      ProxyState state = startProxy({*snapshot, 0}, settingsOf(), finger);
      for (std::int64_t t = period; t < way_ns + period; t += period) {
        tick(state, {*snapshot, t}, settingsOf(), finger);
        const Vec3 own = motion.at(t).toObject(state.position);
        ASSERT_GE(own.y(), kRadius * (1 - 1e-9)) << rate << " rad/s, " << period << " ns, t " << t;
      }
      const double beyond = 0.06 * std::sin(M_PI / 3);  // the finger's distance from the paddle at the end
      EXPECT_NEAR((state.position - finger).norm(), beyond + kRadius, 1e-6);
    }
  }
}

TEST(Moving, ABoxPushesTheProxyAlongTheFloor) {
  const Model floor = rectangle({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  for (const double speed : {0.05, 1.0, 10.0}) {
    const auto way_ns = static_cast<std::int64_t>(0.2 / speed * 1e9);
    const Motion motion = Motion(at({-0.1, 0.0201, 0})).then(at({0.1, 0.0201, 0}), 0, way_ns);
    const auto snapshot = makeSnapshot({place(1, floor, Motion()), place(2, boxModel(Vec3::Constant(0.02)), motion)});
    const Vec3 finger(0, -0.003, 0);  // presses on the floor in the box's way
    ProxyState state = startProxy({*snapshot, 0}, settingsOf(), Vec3(0, 0.01, 0));
    for (std::int64_t t = kMs / 4; t < way_ns; t += kMs / 4) {
      tick(state, {*snapshot, t}, settingsOf(), finger);
      const Vec3 own = motion.at(t).toObject(state.position);
      ASSERT_GE(state.position.y(), kRadius * (1 - 1e-9));
      ASSERT_GE(own.x(), 0.02 + kRadius * (1 - 1e-9)) << "in front of the box, " << speed << " m/s";
    }
  }
}

// M4. Two plates close to half the proxy's size, and open again.
TEST(Moving, APinchIsBoundedAndRecovers) {
  const Model plate = rectangle({-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1});
  const std::int64_t way_ns = 100 * kMs;
  const double gap = 0.5 * kRadius;
  const auto motionOf = [&](double side) {
    return Motion(at({0, side * 0.02, 0}))
        .then(at({0, side * gap, 0}), 0, way_ns)
        .then(at({0, side * 0.02, 0}), way_ns, 2 * way_ns);
  };
  const Motion lower = motionOf(-1), upper = motionOf(1);
  const auto snapshot = makeSnapshot({place(1, plate, lower), place(2, plate, upper)});
  const Vec3 finger(0, 0.001, 0);
  ProxyState state = startProxy({*snapshot, 0}, settingsOf(), finger);
  for (std::int64_t t = kMs; t <= 2 * way_ns; t += kMs) {
    tick(state, {*snapshot, t}, settingsOf(), finger);
    EXPECT_LT((state.position - finger).norm(), 2 * kRadius) << "the pull stays small";
    EXPECT_GT(state.position.y(), lower.at(t).origin.y()) << t;
    EXPECT_LT(state.position.y(), upper.at(t).origin.y()) << t;
  }
  EXPECT_LT((state.position - finger).norm(), 1e-9) << "open again";
}

// A belt under a pressing finger: without friction it slips through beneath, with friction it takes the proxy along
// until the pull is mu times the press.
TEST(Moving, FrictionTakesTheProxyAlongUntilItSlips) {
  const double depth = 0.005, mu = 0.5;
  const Model belt = rectangle({-1, 0, 0.5}, {2, 0, 0}, {0, 0, -1});
  const Motion motion = Motion(at({0, 0, 0})).then(at({0.1, 0, 0}), 100 * kMs, 1100 * kMs);
  const auto snapshot = makeSnapshot({place(1, belt, motion)});
  const Vec3 finger(0, kRadius - depth, 0);
  for (const double friction : {0.0, mu}) {
    const ProxySettings settings = settingsOf(friction, friction);
    ProxyState state = startProxy({*snapshot, 0}, settings, Vec3(0, 0.01, 0));
    double before = 0;
    for (std::int64_t t = kMs; t <= 1000 * kMs; t += kMs) {
      tick(state, {*snapshot, t}, settings, finger);
      if (t == 110 * kMs) before = state.position.x();
    }
    EXPECT_NEAR(before, friction > 0 ? 0.001 : 0, 1e-5) << "stuck to the belt, which has moved 1 mm";
    EXPECT_NEAR(state.position.x(), friction * depth, 2e-5);
    EXPECT_NEAR(state.position.y(), kRadius, 1e-8);
  }
}

// A box that tumbles about at random while the finger does the same: the proxy is never within it.
TEST(Moving, ATumblingBoxNeverSwallowsTheProxy) {
  const Vec3 half(0.03, 0.02, 0.01);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Random random(seed);
    const std::int64_t frame = random.below(2) == 0 ? 16 * kMs : 100 * kMs;
    Instance box = place(1, boxModel(half), Motion(at({0.1, 0, 0})));
    auto snapshot = makeSnapshot({box});
    Vec3 finger = Vec3::Zero();
    ProxyState state = startProxy({*snapshot, 0}, settingsOf(), finger);
    ASSERT_TRUE(state.free);
    std::int64_t next_frame = frame;
    int contacts = 0;
    for (std::int64_t t = kMs; t < 4000 * kMs; t += kMs) {
      if (t >= next_frame) {
        const Pose goal{Eigen::AngleAxisd(random.uniform(0, 3), random.direction()).toRotationMatrix(),
                        random.inCube(0.03)};
        box.motion = box.motion.then(goal, t + kMs / 2, t + kMs / 2 + frame);
        snapshot = makeSnapshot({box});
        next_frame += frame;
      }
      finger = 0.995 * finger + random.inCube(0.002);
      const TickReport report = tick(state, {*snapshot, t}, settingsOf(), finger);
      contacts += report.contacts.empty() ? 0 : 1;
      const Vec3 own = box.motion.at(t).toObject(state.position);
      ASSERT_TRUE((own.cwiseAbs().array() > half.array()).any()) << "seed " << seed << " t " << t;
      ASSERT_GE(judge::clearance({*snapshot, t}, state.position, kRadius), kRadius * (1 - 1e-6));
      ASSERT_FALSE(report.capped());
    }
    EXPECT_GT(contacts, 300);
  }
}

TEST(Moving, TheWorkOfObjectsIsBookedAsTheirs) {
  const Model plate = rectangle({-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1});
  const Motion motion = Motion(at({0, -0.004, 0})).then(at({0, 0.006, 0}), 0, 100 * kMs);
  const auto snapshot = makeSnapshot({place(1, plate, motion)});
  ProxyState state = startProxy({*snapshot, 0}, settingsOf(), Vec3::Zero());
  double injected = 0;
  for (std::int64_t t = kMs; t <= 200 * kMs; t += kMs)
    injected += std::max(0.0, tick(state, {*snapshot, t}, settingsOf(), Vec3::Zero()).injected_J);
  const double whole_J = 0.5 * 1000 * std::pow(0.006 + kRadius, 2);
  EXPECT_NEAR(state.ledger.by_cause_J[static_cast<std::size_t>(EnergyCause::kMoving)], whole_J, 0.01 * whole_J);
  EXPECT_LT(injected, 1e-12);
}

TEST(Moving, NoAllocation) {
  const Model floor = rectangle({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  const Motion motion = Motion(at({-0.1, 0.0201, 0})).then(at({0.1, 0.0201, 0}), 0, 20 * kMs);
  const auto snapshot = makeSnapshot({place(1, floor, Motion()), place(2, boxModel(Vec3::Constant(0.02)), motion)});
  const ProxySettings settings = settingsOf(0.5, 0.3);
  ProxyState state = startProxy({*snapshot, 0}, settings, Vec3(0, 0.01, 0));
  const RealtimeGuard guard;
  for (std::int64_t t = kMs; t < 20 * kMs; t += kMs) tick(state, {*snapshot, t}, settings, Vec3(0, -0.003, 0));
}

}  // namespace
}  // namespace hl::test_moving
