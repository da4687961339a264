// Meshes that bend against a proxy: from frame to frame it stays on its side of them.
#include "proxy/carry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "guard/realtime_guard.h"
#include "moving_scenes.h"
#include "proxy/proxy.h"

namespace hl::test_mesh_motion {
namespace {

constexpr double kRadius = 0.002;
constexpr double kClear = kRadius * (1 - 1e-6);

ProxySettings settingsOf(double friction = 0) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.surfaces.static_friction = settings.surfaces.dynamic_friction = friction;
  return settings;
}

using test::sheet;

constexpr std::int64_t kTick_ns = 1'000'000, kFrame_ns = 33 * kTick_ns;

// One mesh that is bent from frame to frame.
class Skin {
 public:
  explicit Skin(Model model, const Pose& pose = {}, std::vector<Instance> others = {})
      : pose_(pose), others_(std::move(others)) {
    show(makeShape(std::move(model)), nullptr);
  }
  // From where it is now.
  void bend(Model model, std::int64_t frame_ns = kFrame_ns) {
    const auto before = snapshot_->instances.front().shape;
    auto shape = makeShape(std::move(model), *before);
    auto mesh_motion = std::make_shared<MeshMotion>(MeshTransition(before, shape, time_ns_, time_ns_ + frame_ns));
    show(std::move(shape), std::move(mesh_motion));
  }
  // Ticks once, now; or until it has come to rest, with a look after each tick.
  TickReport tickNow(ProxyState& state, const Vec3& finger, double friction = 0) const {
    return tick(state, SceneAt(*snapshot_, time_ns_), settingsOf(friction), finger);
  }
  TickReport feel(ProxyState& state, const Vec3& finger, double friction = 0,
                  const std::function<void()>& look = nullptr) {
    TickReport report;
    do {
      time_ns_ += kTick_ns;
      report = tickNow(state, finger, friction);
      if (look) look();
    } while (time_ns_ < snapshot_->deforms_until_ns);
    return report;
  }
  SceneAt now() const { return {*snapshot_, time_ns_}; }

 private:
  void show(std::shared_ptr<const Shape> shape, std::shared_ptr<const MeshMotion> mesh_motion) {
    Instance instance;
    instance.surfaces = surfacesOf(shape);
    instance.shape = std::move(shape);
    instance.motion = Motion(pose_);
    instance.key = 1;
    instance.mesh_motion = std::move(mesh_motion);
    std::vector<Instance> all = others_;
    all.push_back(std::move(instance));
    snapshot_ = makeSnapshot(std::move(all), "skin", ++number_);
  }

  Pose pose_;
  std::vector<Instance> others_;  // with greater keys
  std::shared_ptr<const Snapshot> snapshot_;
  std::uint64_t number_ = 0;
  std::int64_t time_ns_ = 0;
};

// The proxy on a flat skin, above a finger that is held beneath it.
ProxyState restingOn(Skin& skin, const Vec3& finger) {
  ProxyState state = startProxy(skin.now(), settingsOf(), Vec3(finger.x(), 0.01, finger.z()));
  skin.feel(state, finger);
  return state;
}

TEST(Bend, ASkinThatRisesAndFallsLiftsTheProxyWhateverItsSpeed) {
  for (const double step : {0.1e-3, 1e-3, 3e-3, 10e-3, 30e-3, 0.3}) {
    Skin skin(sheet([](double, double) { return 0; }));
    const Vec3 finger(0.011, -0.004, 0.007);
    ProxyState state = restingOn(skin, finger);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> move(-step, step);
    double height = 0;
    for (int frame = 0; frame < 300; ++frame) {
      height = std::clamp(height + move(random), -0.003, 0.05);
      skin.bend(sheet([&](double, double) { return height; }));
      const TickReport report = skin.feel(state, finger);
      ASSERT_FALSE(report.capped());
      ASSERT_NEAR(state.position.y() - height, kRadius, 1e-8) << "steps up to " << step << " m, frame " << frame;
    }
  }
}

TEST(Bend, BothSidesAreSides) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0.011, 0.004, 0.007);
  ProxyState state = startProxy(skin.now(), settingsOf(), Vec3(0.011, -0.01, 0.007));
  skin.feel(state, finger);
  skin.bend(sheet([](double, double) { return -0.02; }));
  skin.feel(state, finger);
  EXPECT_NEAR(state.position.y(), -0.02 - kRadius, 1e-8);
}

TEST(Bend, WhatIsNotTouchedYetIsMetOnTheWay) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0, 0.006, 0);  // three radii above
  ProxyState state = startProxy(skin.now(), settingsOf(), finger);
  skin.feel(state, finger);
  ASSERT_FALSE(state.touching);
  skin.bend(sheet([](double, double) { return 0.02; }));
  skin.feel(state, finger);
  EXPECT_NEAR(state.position.y(), 0.02 + kRadius, 1e-8);
  skin.bend(sheet([](double, double) { return 0; }));
  skin.feel(state, finger);
  EXPECT_EQ(state.position, finger) << "it has gone";
}

TEST(Bend, AWaveThatRunsBeneathTheProxyNeverPassesIt) {
  for (const double speed : {0.1, 0.5, 2.0}) {  // of the phase, rad a frame
    double phase = 0;
    const auto wave = [&](double x, double z) { return 0.008 * std::sin(90 * x + phase) * std::cos(40 * z); };
    Skin skin(sheet(wave));
    const Vec3 finger(0.004, -0.02, 0.003);
    ProxyState state = startProxy(skin.now(), settingsOf(), Vec3(0.004, 0.03, 0.003));
    for (int frame = 0; frame < 300; ++frame) {
      skin.feel(state, finger);
      const Vec3& p = state.position;
      // The sheet's triangles lie up to 0.1 mm beside the wave.
      ASSERT_GT(p.y(), wave(p.x(), p.z()) - 1e-4) << speed << " rad a frame, frame " << frame;
      phase += speed;
      skin.bend(sheet(wave));
    }
  }
}

TEST(Bend, InAFrameThatIsTurnedToo) {
  const Pose pose{Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized()).toRotationMatrix(), Vec3(0.3, -0.2, 0.1)};
  Skin skin(sheet([](double, double) { return 0; }), pose);
  const Vec3 finger = pose.toWorld(Vec3(0.01, -0.004, 0.005));
  ProxyState state = startProxy(skin.now(), settingsOf(), pose.toWorld(Vec3(0.01, 0.01, 0.005)));
  skin.feel(state, finger);
  for (const double height : {0.01, 0.02, 0.045, 0.03}) {
    skin.bend(sheet([&](double, double) { return height; }));
    skin.feel(state, finger);
    EXPECT_NEAR(pose.toObject(state.position).y(), height + kRadius, 1e-8);
  }
}

TEST(Bend, AFlapTurnsTheProxyWithIt) {
  double angle = 0;
  const auto flap = [&] {
    Model model = sheet([](double, double) { return 0; }, 8);
    for (Vec3& p : model.positions) p = Vec3(std::cos(angle) * p.x(), std::sin(angle) * p.x(), p.z());
    return model;
  };
  Skin skin(flap());
  const Vec3 finger(0.02, -0.01, 0);
  ProxyState state = restingOn(skin, finger);
  for (int frame = 0; frame < 30; ++frame) {
    angle += 0.05;  // 2.5 mm a frame at its end
    skin.bend(flap());
    skin.feel(state, finger);
    const double above = std::cos(angle) * state.position.y() - std::sin(angle) * state.position.x();
    ASSERT_GE(above, kClear) << "frame " << frame;
  }
}

TEST(Bend, AgainstACeilingTheCentreStaysBetween) {
  Model ceiling = sheet([](double, double) { return 0.01; });
  Instance above;
  above.shape = makeShape(std::move(ceiling));
  above.surfaces = surfacesOf(above.shape);
  above.key = 2;
  Skin skin(sheet([](double, double) { return 0; }), {}, {above});
  const Vec3 finger(0, -0.004, 0);
  ProxyState state = startProxy(skin.now(), settingsOf(), Vec3(0, 0.005, 0));
  skin.feel(state, finger);
  for (const double height : {0.003, 0.0075, 0.009, 0.002}) {  // at the third there is no room for it
    skin.bend(sheet([&](double, double) { return height; }));
    skin.feel(state, finger);
    EXPECT_GT(state.position.y(), height);
    EXPECT_LT(state.position.y(), 0.01);
  }
  EXPECT_NEAR(state.position.y(), 0.002 + kRadius, 1e-8);
}

// A skin that is drawn along: without friction it slips through beneath, with friction it takes the proxy along until
// the pull is mu times the press.
TEST(Bend, FrictionTakesTheProxyAlongUntilItSlips) {
  const double depth = 0.005, mu = 0.5, step = 0.2e-3;
  const auto drawn = [](double by) {
    Model model = sheet([](double, double) { return 0; });
    for (Vec3& p : model.positions) p.x() += by;
    return model;
  };
  for (const double friction : {0.0, mu}) {
    Skin skin(drawn(0));
    const Vec3 finger(0.0013, kRadius - depth, 0.0007);
    ProxyState state = startProxy(skin.now(), settingsOf(friction), Vec3(0.0013, 0.01, 0.0007));
    for (int frame = 0; frame < 100; ++frame) {
      skin.feel(state, finger, friction);
      const double pulled = std::min(frame * step, mu * depth);
      ASSERT_NEAR(state.position.x(), finger.x() + (friction > 0 ? pulled : 0), 2e-5) << "frame " << frame;
      ASSERT_NEAR(state.position.y(), kRadius, 1e-8);
      skin.bend(drawn((frame + 1) * step));
    }
  }
}

TEST(Bend, AWallHoldsWhatFrictionTakesAlong) {
  Model wall;
  wall.positions = {{0.01, -0.1, -0.1}, {0.01, 0.1, -0.1}, {0.01, 0, 0.1}};
  wall.triangles = {{0, 1, 2}};
  Instance beside;
  beside.shape = makeShape(std::move(wall));
  beside.surfaces = surfacesOf(beside.shape);
  beside.key = 2;
  double by = 0;
  const auto drawn = [&] {
    Model model = sheet([](double, double) { return 0; });
    for (Vec3& p : model.positions) p.x() += by;
    return model;
  };
  Skin skin(drawn(), {}, {beside});
  const Vec3 finger(0.005, -0.02, 0);
  ProxyState state = startProxy(skin.now(), settingsOf(1), Vec3(0.005, 0.01, 0));
  for (int frame = 0; frame < 30; ++frame) {
    skin.feel(state, finger, 1);
    ASSERT_LE(state.position.x(), 0.01 - kClear) << "frame " << frame;
    ASSERT_GE(state.position.y(), kClear) << "frame " << frame;
    by += 0.3e-3;
    skin.bend(drawn());
  }
  EXPECT_NEAR(state.position.x(), 0.01 - kRadius, 1e-8);
}

// The triangles it rests on shrink to a line and come back; elsewhere a vertex goes beyond all reach and comes back.
TEST(Bend, TrianglesMayShrinkToNothingAndComeBack) {
  Skin skin(sheet([](double, double) { return 0; }, 5));
  const Vec3 finger(0.003, -0.004, 0.002);
  ProxyState state = restingOn(skin, finger);
  double height = 0;
  for (const double width : {1.0, 0.0, 1.0, 1e-300, 1.0, 1e-12, 0.5, 0.0, 1.0}) {
    height += 0.008;
    Model narrow = sheet([&](double, double) { return height; }, 5);
    for (Vec3& p : narrow.positions) {
      if (std::abs(p.x()) < 0.011) p.x() *= width;
    }
    skin.bend(narrow);
    skin.feel(state, finger);
    ASSERT_NEAR(state.position.y(), height + kRadius, 1e-8) << "of width " << width;
  }
  for (const double corner : {std::numeric_limits<double>::quiet_NaN(), 1e300, height}) {
    Model torn = sheet([&](double, double) { return height; }, 5);
    torn.positions.front().y() = corner;
    skin.bend(torn);
    skin.feel(state, finger);
    EXPECT_NEAR(state.position.y(), height + kRadius, 1e-8);
  }
}

// A steep pit that recedes and goes aside. Finger and proxy stay above both places of the sheet, and so must the proxy
// all the way between them: its places nearest to the proxy before and after have little to do with one another.
TEST(Bend, APitThatRecedesAndGoesAsideLetsNothingThrough) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int felt = 0;
  for (int i = 0; i < 200; ++i) {
    const double depth = 0.002 + 0.02 * unit(random), width = 0.003 + 0.006 * unit(random);
    const double left = 1 - 1.2 * unit(random);  // of the depth
    const Vec3 aside(0.02 * (unit(random) - 0.5), 0, 0.02 * (unit(random) - 0.5));
    const auto pit = [&](double by) {
      return [=, &aside](double x, double z) {
        const double d2 = std::pow(x - by * aside.x(), 2) + std::pow(z - by * aside.z(), 2);
        return -depth * (1 - by * (1 - left)) * std::exp(-d2 / (width * width));
      };
    };
    Skin skin(sheet(pit(0)));
    const Vec3 finger(0.01 * (unit(random) - 0.5), 0.01 * (unit(random) - 0.7), 0.01 * (unit(random) - 0.5));
    ProxyState state = startProxy(skin.now(), settingsOf(), Vec3(0, 0.03, 0));
    skin.feel(state, finger);
    for (const double by : {1.0, 0.3, 0.0}) {
      skin.bend(sheet(pit(by)));
      skin.feel(state, finger);
      // Along the vertical through the proxy the sheet is crossed once: its triangles are known.
      SceneImpact impact;
      ASSERT_FALSE(skin.now().firstImpact(state.position, Vec3(0, 0.1, 0), 1e-9, -1, impact)) << "sheet " << i;
      ASSERT_TRUE(skin.now().firstImpact(state.position, Vec3(0, -0.1, 0), 1e-9, -1, impact)) << "sheet " << i;
      felt += state.touching ? 1 : 0;
    }
  }
  EXPECT_GT(felt, 200);
}

TEST(Bend, ItIsInOnePlaceAtEveryMoment) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0, -0.004, 0);
  ProxyState state = restingOn(skin, finger);
  skin.bend(sheet([](double, double) { return 0.033; }));
  double height = 0;
  skin.feel(state, finger, 0, [&] {
    height += 0.001;
    EXPECT_NEAR(state.position.y() - height, kRadius, 1e-8);
    EXPECT_TRUE(state.touching);
  });
}

TEST(Bend, AllocatesNothing) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0, -0.004, 0);
  ProxyState state = restingOn(skin, finger);
  skin.bend(sheet([](double, double) { return 0.01; }));
  const RealtimeGuard guard;
  skin.feel(state, finger);
}

}  // namespace
}  // namespace hl::test_mesh_motion
