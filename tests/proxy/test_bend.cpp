// Meshes that bend against a proxy: from frame to frame it stays on its side of them.
#include "proxy/bend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "base/realtime_guard.h"

namespace hl {
namespace {

constexpr double kRadius = 0.002;
constexpr double kClear = kRadius * (1 - 1e-6);

ProxySettings settingsOf(double friction = 0) {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.surfaces.static_friction = settings.surfaces.dynamic_friction = friction;
  return settings;
}

using Height = std::function<double(double x, double z)>;

// A sheet of 0.1 m x 0.1 m around the origin.
Model sheet(const Height& height, int cells = 40) {
  Model model;
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      const double x = 0.1 * i / cells - 0.05, z = 0.1 * k / cells - 0.05;
      model.positions.emplace_back(x, height(x, z), z);
    }
  }
  const auto at = [cells](int i, int k) { return static_cast<std::uint32_t>(i * (cells + 1) + k); };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      model.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      model.triangles.push_back({at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)});
    }
  }
  return model;
}

// One object after the other in the same place, each the one before bent.
class Skin {
 public:
  explicit Skin(Model model, const Pose& pose = {}, std::vector<Instance> others = {})
      : pose_(pose), others_(std::move(others)) {
    show(makeShape(std::move(model)), nullptr);
  }
  void bend(Model model) {
    const auto before = snapshot_->instances.front().shape;
    show(makeShape(std::move(model), *before), before);
  }
  const Snapshot& snapshot() const { return *snapshot_; }

 private:
  void show(std::shared_ptr<const Shape> shape, std::shared_ptr<const Shape> before) {
    Instance instance;
    instance.surfaces = surfacesOf(shape);
    instance.shape = std::move(shape);
    instance.motion = Motion(pose_);
    instance.key = 1;
    instance.before = std::move(before);
    std::vector<Instance> all = others_;
    all.push_back(std::move(instance));
    snapshot_ = makeSnapshot(std::move(all), "skin", ++number_);
  }

  Pose pose_;
  std::vector<Instance> others_;  // with greater keys
  std::shared_ptr<const Snapshot> snapshot_;
  std::uint64_t number_ = 0;
};

// The proxy on a flat skin, above a finger that is held beneath it.
ProxyState restingOn(const Skin& skin, const Vec3& finger) {
  ProxyState state = startProxy(skin.snapshot(), settingsOf(), Vec3(finger.x(), 0.01, finger.z()));
  tick(state, skin.snapshot(), settingsOf(), finger);
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
      const TickReport report = tick(state, skin.snapshot(), settingsOf(), finger);
      ASSERT_FALSE(report.capped);
      ASSERT_NEAR(state.position.y() - height, kRadius, 1e-8) << "steps up to " << step << " m, frame " << frame;
    }
  }
}

TEST(Bend, BothSidesAreSides) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0.011, 0.004, 0.007);
  ProxyState state = startProxy(skin.snapshot(), settingsOf(), Vec3(0.011, -0.01, 0.007));
  tick(state, skin.snapshot(), settingsOf(), finger);
  skin.bend(sheet([](double, double) { return -0.02; }));
  tick(state, skin.snapshot(), settingsOf(), finger);
  EXPECT_NEAR(state.position.y(), -0.02 - kRadius, 1e-8);
}

TEST(Bend, WhatIsNotTouchedYetIsMetOnTheWay) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0, 0.006, 0);  // three radii above
  ProxyState state = startProxy(skin.snapshot(), settingsOf(), finger);
  tick(state, skin.snapshot(), settingsOf(), finger);
  ASSERT_FALSE(state.touching);
  skin.bend(sheet([](double, double) { return 0.02; }));
  tick(state, skin.snapshot(), settingsOf(), finger);
  EXPECT_NEAR(state.position.y(), 0.02 + kRadius, 1e-8);
  skin.bend(sheet([](double, double) { return 0; }));
  tick(state, skin.snapshot(), settingsOf(), finger);
  EXPECT_EQ(state.position, finger) << "it has gone";
}

TEST(Bend, AWaveThatRunsBeneathTheProxyNeverPassesIt) {
  for (const double speed : {0.1, 0.5, 2.0}) {  // of the phase, rad a frame
    double phase = 0;
    const auto wave = [&](double x, double z) { return 0.008 * std::sin(90 * x + phase) * std::cos(40 * z); };
    Skin skin(sheet(wave));
    const Vec3 finger(0.004, -0.02, 0.003);
    ProxyState state = startProxy(skin.snapshot(), settingsOf(), Vec3(0.004, 0.03, 0.003));
    for (int frame = 0; frame < 300; ++frame) {
      tick(state, skin.snapshot(), settingsOf(), finger);
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
  ProxyState state = startProxy(skin.snapshot(), settingsOf(), pose.toWorld(Vec3(0.01, 0.01, 0.005)));
  tick(state, skin.snapshot(), settingsOf(), finger);
  for (const double height : {0.01, 0.02, 0.045, 0.03}) {
    skin.bend(sheet([&](double, double) { return height; }));
    tick(state, skin.snapshot(), settingsOf(), finger);
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
    tick(state, skin.snapshot(), settingsOf(), finger);
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
  ProxyState state = startProxy(skin.snapshot(), settingsOf(), Vec3(0, 0.005, 0));
  tick(state, skin.snapshot(), settingsOf(), finger);
  for (const double height : {0.003, 0.0075, 0.009, 0.002}) {  // at the third there is no room for it
    skin.bend(sheet([&](double, double) { return height; }));
    tick(state, skin.snapshot(), settingsOf(), finger);
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
    ProxyState state = startProxy(skin.snapshot(), settingsOf(friction), Vec3(0.0013, 0.01, 0.0007));
    for (int frame = 0; frame < 100; ++frame) {
      tick(state, skin.snapshot(), settingsOf(friction), finger);
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
  ProxyState state = startProxy(skin.snapshot(), settingsOf(1), Vec3(0.005, 0.01, 0));
  for (int frame = 0; frame < 30; ++frame) {
    tick(state, skin.snapshot(), settingsOf(1), finger);
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
    tick(state, skin.snapshot(), settingsOf(), finger);
    ASSERT_NEAR(state.position.y(), height + kRadius, 1e-8) << "of width " << width;
  }
  for (const double corner : {std::numeric_limits<double>::quiet_NaN(), 1e300, height}) {
    Model torn = sheet([&](double, double) { return height; }, 5);
    torn.positions.front().y() = corner;
    skin.bend(torn);
    tick(state, skin.snapshot(), settingsOf(), finger);
    EXPECT_NEAR(state.position.y(), height + kRadius, 1e-8);
  }
}

TEST(Bend, OfAnotherSnapshotThanTheNextNothingIsKnown) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0, -0.004, 0);
  ProxyState state = restingOn(skin, finger);
  skin.bend(sheet([](double, double) { return 0.01; }));
  skin.bend(sheet([](double, double) { return 0.02; }));
  const Vec3 was = state.position;
  bend(state, skin.snapshot(), settingsOf());
  EXPECT_EQ(state.position, was);
}

TEST(Bend, AllocatesNothing) {
  Skin skin(sheet([](double, double) { return 0; }));
  const Vec3 finger(0, -0.004, 0);
  ProxyState state = restingOn(skin, finger);
  skin.bend(sheet([](double, double) { return 0.01; }));
  const RealtimeGuard guard;
  tick(state, skin.snapshot(), settingsOf(), finger);
}

}  // namespace
}  // namespace hl
