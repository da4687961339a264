// A surface that takes the place of another while the proxy is there: the proxy is never in matter, and goes on from
// its side.
#include "proxy/leave_matter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/scenes.h"
#include "guard/realtime_guard.h"
#include "phantom.h"
#include "proxy/clear_place.h"
#include "proxy/proxy.h"
#include "scene/iso_shape.h"

namespace hl::test_leave_matter {
namespace {

using test::Random;

// Trilinear, by the samples alone; outside of the volume there is air.
double valueAt(const IsoSurface& surface, const Vec3& point) {
  const VoxelGrid& grid = surface.volume()->grid;
  const GridFrame& frame = surface.frame();
  const Vec3 place = frame.axes.inverse() * (point - frame.origin);
  std::array<std::uint32_t, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (!(place[axis] >= 0 && place[axis] <= grid.cells(i))) return -INFINITY;
    at[i] = std::min(static_cast<std::uint32_t>(place[axis]), grid.cells(i) - 1);
  }
  double sum = 0;
  for (unsigned c = 0; c < 8; ++c) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double part = place[axis] - at[static_cast<std::size_t>(axis)];
      weight *= (c >> axis & 1U) != 0 ? part : 1 - part;
    }
    sum += weight * grid.at(at[0] + (c & 1U), at[1] + (c >> 1U & 1U), at[2] + (c >> 2U & 1U));
  }
  return sum;
}

// A scene in which one surface changes its value from snapshot to snapshot.
class Changing {
 public:
  explicit Changing(const SceneModel& model) : shown_(makeSnapshot(model)) {}

  void setIso(std::size_t number, double value) {
    std::vector<Instance> instances = shown_->instances;
    instances[number].shape = withIso(*instances[number].shape, {value});
    instances[number].replaced_in = shown_->number + 1;
    shown_ = makeSnapshot(std::move(instances), "", shown_->number + 1);
  }
  const Snapshot& shown() const { return *shown_; }
  const IsoSurface& surface(std::size_t number) const { return *isoSurfaceOf(shown_->instances[number]); }

 private:
  std::shared_ptr<const Snapshot> shown_;
};

const ProxySettings kSettings = [] {
  ProxySettings settings;
  settings.radius = 0.002;
  return settings;
}();

// A finger that presses on the top of the skin, 10 mm deep.
class OnPhantom : public testing::Test {
 protected:
  OnPhantom() : scene_(makePhantom(81)) {
    for (double y = 0.09; y > finger_.y(); y -= 0.0005) step(Vec3(finger_.x(), y, finger_.z()));
    for (int i = 0; i < 10; ++i) step(finger_);
  }

  TickReport step(const Vec3& finger) {
    const SceneAt scene(scene_.shown());
    const TickReport report = tick(state_, scene, kSettings, finger);
    EXPECT_TRUE(report.valid());
    EXPECT_GE(clearanceAt(scene, state_.position, kSettings.radius), (1 - 1e-9) * kSettings.radius);
    return report;
  }
  bool outside() const {
    for (std::size_t i = 0; i < scene_.shown().instances.size(); ++i) {
      if (valueAt(scene_.surface(i), state_.position) >= scene_.surface(i).iso().value) return false;
    }
    return true;
  }

  Changing scene_;
  ProxyState state_;
  Vec3 finger_ = Vec3(0.005, 0.042, 0);
};

TEST_F(OnPhantom, IsNeverSwallowedWhileTheValueSweeps) {
  ASSERT_TRUE(state_.touching);
  const double below_m = state_.position.y();
  for (const int direction : {1, -1, 1, -1}) {
    for (int i = 0; i <= 24; ++i) {
      const double value = direction > 0 ? -900 + 50 * i : 300 - 50 * i;
      scene_.setIso(0, value);
      for (int k = 0; k < 5; ++k) {
        step(finger_);
        ASSERT_TRUE(outside()) << value << " HU, tick " << k;
        // From -960 to 0 HU skin is where the ramp of two samples of 2 mm is.
        if (value < 0) {
          ASSERT_TRUE(state_.touching) << value;
          ASSERT_NEAR(state_.position.y(), below_m, 0.0045) << value << " HU, tick " << k;
        }
        if (value > 50) {
          ASSERT_LT((state_.position - finger_).norm(), 1e-6) << "there is no skin: free";
        }
      }
    }
  }
}

TEST_F(OnPhantom, RestsWhereItWouldHaveRestedFromTheStart) {
  for (const double value : {300.0, -900.0}) {
    scene_.setIso(0, value);
    for (int i = 0; i < 20; ++i) step(finger_);
  }
  const Vec3 after = state_.position;
  Changing fresh(makePhantom(81));
  fresh.setIso(0, -900);
  ProxyState state;
  for (double y = 0.09; y > finger_.y(); y -= 0.0005)
    tick(state, SceneAt(fresh.shown()), kSettings, Vec3(finger_.x(), y, finger_.z()));
  for (int i = 0; i < 20; ++i) tick(state, SceneAt(fresh.shown()), kSettings, finger_);
  EXPECT_LT((after - state.position).norm(), 1e-5);
}

TEST_F(OnPhantom, AValueWithoutASurfaceLeavesItFree) {
  for (const double value : {-2000.0, 5000.0, -2000.0}) {
    scene_.setIso(0, value);
    for (int i = 0; i < 20; ++i) step(finger_);
    EXPECT_LT((state_.position - finger_).norm(), 1e-6) << value;
  }
  scene_.setIso(0, -480);
  step(finger_);
  EXPECT_TRUE(outside());
}

// A proxy that is within, as when it has pierced the skin, is not brought out by another value.
TEST_F(OnPhantom, WhatItIsWithinItStaysWithin) {
  const Vec3 inside(finger_.x(), 0.03, finger_.z());
  state_.position = inside;
  step(inside);
  EXPECT_EQ(state_.position, inside);
  ASSERT_EQ(state_.within.size(), 1U);
  for (const double value : {-600.0, -300.0, -800.0}) {
    scene_.setIso(0, value);
    step(inside);
    EXPECT_EQ(state_.position, inside) << value;
  }
}

// Only so many surfaces are asked in each tick for the matter around the proxy; where one is replaced all count.
TEST_F(OnPhantom, IsNotSwallowedByTheLastOfManySurfaces) {
  const SceneModel phantom = makePhantom(81);
  SceneModel many;
  for (std::size_t i = 0; i < kMaxMatter; ++i)
    many.surfaces.push_back({"far", phantom.surfaces[1].source->placed(Mat3::Identity(), Vec3(1 + 0.3 * i, 0, 0))});
  many.surfaces.push_back(phantom.surfaces[0]);
  Changing scene(many);
  EXPECT_EQ(scene.shown().matter.size(), kMaxMatter);
  scene.setIso(kMaxMatter, 5000);  // no surface: the finger comes to where there will be matter
  const Vec3 finger(0.005, 0.03, 0);
  ProxyState state = startProxy(scene.shown(), kSettings, finger);
  ASSERT_EQ(state.position, finger);
  tick(state, scene.shown(), kSettings, finger);
  scene.setIso(kMaxMatter, -480);
  tick(state, scene.shown(), kSettings, finger);
  EXPECT_LT(valueAt(scene.surface(kMaxMatter), state.position), -480);
}

TEST_F(OnPhantom, OtherScenesMoveItNot) {
  const Vec3 before = state_.position;
  scene_.setIso(1, 600);  // far beneath
  step(finger_);
  EXPECT_EQ(state_.position, before);
}

TEST_F(OnPhantom, IsRealTime) {
  scene_.setIso(0, 300);
  step(finger_);
  scene_.setIso(0, -900);
  const SceneAt scene(scene_.shown());
  const RealtimeGuard guard;
  leaveMatter(state_, scene, kSettings, finger_);
}

// Exact tests made on the way out of the skin, with these others in the scene.
std::size_t testsOnWayOut(const Snapshot& before, const ProxyState& within, const Vec3& finger,
                          const std::vector<Instance>& others) {
  std::vector<Instance> instances = before.instances;
  instances[0].shape = withIso(*instances[0].shape, {-900});
  instances[0].replaced_in = before.number + 1;
  for (const Instance& one : others) {
    instances.push_back(one);
    instances.back().key = 1000 + instances.size();
  }
  const auto grown = makeSnapshot(std::move(instances), "", before.number + 1);
  ProxyState state = within;
  const SceneAt scene(*grown);
  leaveMatter(state, scene, kSettings, finger);
  EXPECT_GT((state.position - within.position).norm(), 1e-3);
  return scene.cost().primitives;
}

// What is asked where matter is counts as work; meshes are not asked.
TEST_F(OnPhantom, TheWayOutCountsAsWork) {
  Model speck;
  speck.positions = {{1, 0, 0}, {1.001, 0, 0}, {1, 0.001, 0}};
  speck.triangles = {{0, 1, 2}};
  Instance mesh;
  mesh.shape = makeShape(speck);
  mesh.surfaces = surfacesOf(mesh.shape);
  Instance volume = scene_.shown().instances[1];
  volume.motion = Motion({Mat3::Identity(), Vec3(0.5, 0, 0)});
  scene_.setIso(0, 300);
  for (int i = 0; i < 10; ++i) step(finger_);
  const auto with = [&](const std::vector<Instance>& others) {
    return testsOnWayOut(scene_.shown(), state_, finger_, others);
  };
  const std::size_t alone = with({mesh});  // the scene has the same extent in all cases, and so the way its places
  EXPECT_EQ(with(std::vector<Instance>(1000, mesh)), alone);
  std::vector<Instance> others(20, volume);
  others.push_back(mesh);
  EXPECT_GE(with(others), alone + 20);
}

// Waves of random form in air, random values, a finger anywhere.
TEST(LeaveMatter, RandomVolumesAndValues) {
  Random random(5);
  int touched = 0;
  for (int i = 0; i < 150; ++i) {
    const std::uint32_t side = 12 + static_cast<std::uint32_t>(random.below(20));
    const Vec3 waves = random.inCube(1.5), phase = random.inCube(3);
    const auto samples = std::make_shared<std::vector<float>>();
    for (std::uint32_t z = 0; z < side; ++z) {
      for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
          const Vec3 at = Vec3(x, y, z) / (side - 1.0);
          const bool rim = (at.array() - 0.5).abs().maxCoeff() > 0.4;
          const double sum = std::sin(9 * waves.x() * at.x() + phase.x()) + std::cos(9 * waves.y() * at.y()) +
                             std::sin(7 * waves.z() * at.z() + at.x() + phase.z());
          samples->push_back(static_cast<float>(rim ? -10 : sum));
        }
      }
    }
    const std::shared_ptr<const void> data(samples, samples->data());
    const auto volume =
        std::make_shared<const Volume>(VoxelGrid({side, side, side}, Samples(SampleKind::kFloat32, data)));
    GridFrame frame;
    frame.axes *= 0.1 / (side - 1);
    SceneModel model;
    model.surfaces.push_back({"", std::make_shared<const IsoSurface>(volume, frame, IsoValue{2.9})});
    Changing scene(model);
    ProxyState state;
    for (int k = 0; k < 40; ++k) {
      if (k > 0) scene.setIso(0, random.uniform(-3.2, 3.2));
      const Vec3 finger = Vec3::Constant(0.05) + random.inCube(0.06);
      for (int n = 0; n < 3; ++n) {
        const SceneAt at(scene.shown());
        tick(state, at, kSettings, finger);
        if (!state.free) continue;
        touched += state.touching ? 1 : 0;
        ASSERT_NE(scene.surface(0).siteOf(state.position), Site::kMatter) << i << " " << k << " " << n;
        ASSERT_GE(clearanceAt(at, state.position, kSettings.radius), (1 - 1e-9) * kSettings.radius) << i << " " << k;
      }
    }
  }
  EXPECT_GT(touched, 1000);
}

}  // namespace
}  // namespace hl::test_leave_matter
