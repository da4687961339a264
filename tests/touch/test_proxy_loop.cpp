// The proxy loop on a virtual clock: scenes that appear, change and go under the finger.
#include "touch/proxy_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "guard/realtime_guard.h"
#include "scene/by_key.h"
#include "scene/editable_scene.h"
#include "scene/follow_on.h"

namespace hl::test_proxy_loop {
namespace {

constexpr double kSpring_N_m = 1000;
constexpr std::int64_t kMs = 1'000'000;

std::shared_ptr<const Shape> floorShape() {
  Model model;
  model.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  model.triangles = {{0, 1, 2}, {0, 2, 3}};
  return makeShape(std::move(model), HierarchyKind::kBvh);
}

// The same with coordinates for textures.
std::shared_ptr<const Shape> texturedFloor() {
  Model model = floorShape()->model;
  model.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return makeShape(std::move(model), HierarchyKind::kBvh);
}

Instance floorAt(double y, std::uint64_t key = 5) {
  Instance instance;
  instance.shape = floorShape();
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = Motion({Mat3::Identity(), {0, y, 0}});
  instance.key = key;
  instance.object = 3;
  instance.name = 9;
  instance.session = 2;
  return instance;
}

// A loop at 1 kHz with a finger that is held still, and the spring's force on it as the servo makes it.
class Bench {
 public:
  explicit Bench(std::vector<Instance> first)
      : slot_(makeSnapshot(std::move(first), "", number_)), loop_(slot_, ProxySettings{}) {
    commands_.radius_W = 0.002;
  }

  void publish(std::vector<Instance> instances, std::int64_t blend_ns = kAbruptBlend_ns) {
    ASSERT_TRUE(slot_.taken());
    slot_.publish(makeSnapshot(std::move(instances), "", ++number_, blend_ns));
  }
  // The largest change of force between two steps, in N.
  double run(int steps, const Vec3& finger) {
    double most = 0;
    for (int i = 0; i < steps; ++i) {
      time_ns_ += kMs;
      const ProxyStep step = loop_.step(time_ns_, finger, commands_, {kSpring_N_m, LedgerMode::kTank, 1e-3});
      const ServoTarget& target = step.held.target;
      const Vec3 force =
          target.valid ? Vec3(kSpring_N_m * target.stiffness * (target.proxy_D - finger)) : Vec3(Vec3::Zero());
      most = std::max(most, (force - force_).norm());
      force_ = force;
      last_ = step;
    }
    return most;
  }

  std::uint64_t number_ = 1;
  SnapshotSlot slot_;
  ProxyLoop loop_;
  ProxyCommands commands_;
  std::int64_t time_ns_ = 0;
  Vec3 force_ = Vec3::Zero();
  ProxyStep last_;
};

// 5 mm deep at 1000 N/m are 7 N; let go within 60 ms that is 0.12 N a step.
constexpr double kGentle_N = 0.15;

TEST(ProxyLoop, AnObjectThatGoesLetsTheForceFadeOut) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.005, 0});
  EXPECT_NEAR(bench.force_.y(), 7, 1e-6);
  bench.publish({});
  EXPECT_LT(bench.run(100, {0, -0.005, 0}), kGentle_N);
  EXPECT_EQ(bench.force_, Vec3::Zero());
  EXPECT_FALSE(bench.last_.held.target.valid);
}

TEST(ProxyLoop, AnObjectThatAppearsAroundTheFingerPushesWithoutAJump) {
  Bench bench({});
  bench.run(10, {0, 0.0005, 0});
  bench.publish({floorAt(0)});
  EXPECT_LT(bench.run(100, {0, 0.0005, 0}), kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 1.5, 1e-6) << "the sphere of 2 mm rests on it";
}

TEST(ProxyLoop, AnObjectOverwrittenUnderTheFingerChangesTheForceWithoutAJump) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  bench.publish({floorAt(0.0015)});
  EXPECT_LT(bench.run(200, {0, -0.003, 0}), kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 6.5, 1e-6);
}

TEST(ProxyLoop, AMovingObjectIsFollowedAtOnce) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  Instance moving = floorAt(0);
  moving.motion =
      moving.motion.then({Mat3::Identity(), {0, 0.002, 0}}, bench.time_ns_ + kMs, bench.time_ns_ + 11 * kMs);
  bench.publish({moving}, 0);
  bench.run(12, {0, -0.003, 0});
  EXPECT_NEAR(bench.force_.y(), 7, 1e-6);
}

// The floor `up` higher, as its client bent it.
Instance bentFloor(const Instance& before, double up, std::int64_t begin_ns, std::int64_t end_ns) {
  Model model = before.shape->model;
  for (Vec3& p : model.positions) p.y() += up;
  const auto shape = makeShape(std::move(model), *before.shape);
  const PlacedShape placed{shape, before.surfaces, before.motion.to(), before.key, 2, 3, 9};
  const std::vector<const Instance*> last{&before};
  return followOn({placed}, last, begin_ns, end_ns).instances.front();
}

// 1 mm up each frame of 20 ms: it is where it should be at each moment, and contacts and force are of that place.
TEST(ProxyLoop, AMeshThatBendsMovesAsAnObjectThatMoves) {
  Instance skin = floorAt(0);
  Bench bench({skin});
  bench.run(100, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  for (int frame = 1; frame <= 4; ++frame) {
    skin = bentFloor(skin, 0.001, bench.time_ns_, bench.time_ns_ + 20 * kMs);
    bench.publish({skin}, 0);
    for (int i = 0; i < 20; ++i) {
      EXPECT_NEAR(bench.run(1, {0, -0.003, 0}), 0.05, 1e-6) << "as much in every step";
      ASSERT_EQ(bench.last_.report.contacts.size(), 1u);
      EXPECT_NEAR(bench.last_.report.contacts[0].multiplier_m * kSpring_N_m, bench.force_.y(), 1e-6);
    }
    EXPECT_NEAR(bench.force_.y(), 5 + frame, 1e-6) << "there when the next frame comes";
  }
}

// A floor that falls away from under the finger faster than the finger follows: no force without a contact.
TEST(ProxyLoop, ForceAndContactsAreOfOnePlaceWhenAMeshGoes) {
  Instance skin = floorAt(0);
  Bench bench({skin});
  bench.run(100, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  skin = bentFloor(skin, -0.013, bench.time_ns_, bench.time_ns_ + 33 * kMs);
  bench.publish({skin}, 0);
  for (int i = 0; i < 40; ++i) {
    EXPECT_LT(bench.run(1, {0, -0.003, 0}), 13.0 / 33 + 1e-6);
    EXPECT_EQ(bench.last_.report.contacts.empty(), bench.force_.isZero(1e-9)) << i;
  }
  EXPECT_EQ(bench.force_, Vec3::Zero());
}

// Frames that come before the mesh is where the last one had it: it goes there first, then on.
TEST(ProxyLoop, FramesThatComeEarlyMakeNoJump) {
  Instance skin = floorAt(0);
  Bench bench({skin});
  bench.run(100, {0, 0.01, 0});
  bench.run(10, {0, -0.003, 0});
  double most = 0;
  for (const int wait : {20, 14, 26, 20, 5, 3, 30, 20, 20}) {
    const std::int64_t begin_ns = bench.time_ns_ + 3 * kMs;
    skin = bentFloor(skin, 0.0002, begin_ns, begin_ns + 20 * kMs);
    bench.publish({skin}, 0);
    most = std::max(most, bench.run(wait, {0, -0.003, 0}));
  }
  bench.run(100, {0, -0.003, 0});
  EXPECT_NEAR(bench.force_.y(), 5 + 9 * 0.2, 1e-6);
  EXPECT_LT(most, 0.061) << "0.6 mm in 10 ms at most";
}

TEST(ProxyLoop, WhatBendsBesideWhatAppearsHurriesNothing) {
  Instance skin = floorAt(-0.1);
  Bench bench({skin});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, 0.0005, 0});
  bench.publish({skin, floorAt(0, 7)});
  double most = bench.run(10, {0, 0.0005, 0});
  for (int frame = 0; frame < 10; ++frame) {
    skin = bentFloor(skin, 0.001, bench.time_ns_, bench.time_ns_ + 8 * kMs);
    bench.publish({skin, floorAt(0, 7)}, 0);
    most = std::max(most, bench.run(8, {0, 0.0005, 0}));
  }
  EXPECT_LT(most, kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 1.5, 1e-6);
}

// What a client may send beside a finger that slides along a floor. All of it leaves the floor as it is.
struct Beside {
  const char* what;
  std::function<std::vector<PlacedShape>(int frame)> frame;
};

std::shared_ptr<const Surfaces> texturedSurfaces(Quantity quantity, double low, double high, float texel) {
  auto surfaces = std::make_shared<Surfaces>();
  Material material;
  material.textureOf(quantity) = {0, low, high};
  surfaces->materials.push_back(material);
  Texture texture;
  texture.width = texture.height = 2;
  texture.texels.assign(4, texel);
  surfaces->textures.push_back(std::make_shared<const Texture>(texture));
  return surfaces;
}

PlacedShape placed(std::uint64_t key, std::shared_ptr<const Shape> shape, std::shared_ptr<const Surfaces> surfaces,
                   const Vec3& origin = Vec3::Zero()) {
  return {std::move(shape), std::move(surfaces), {Mat3::Identity(), origin}, key, 2, 3, 9};
}

std::vector<Beside> allBeside() {
  const auto floor = texturedFloor(), stone = floorShape();
  const PlacedShape floor_there = placed(5, floor, surfacesOf(floor));
  const auto beside = [=](std::shared_ptr<const Shape> shape, double x,
                          std::shared_ptr<const Surfaces> surfaces) -> std::vector<PlacedShape> {
    return {floor_there, placed(7, std::move(shape), std::move(surfaces), {x, -0.5, 0})};
  };
  const auto plain = surfacesOf(stone);
  const auto redrawn = std::make_shared<std::shared_ptr<const Shape>>(floor);
  const auto bent = std::make_shared<std::shared_ptr<const Shape>>(stone);
  const auto odd = [](int frame) { return frame % 2 == 1; };
  std::vector<Beside> all;
  all.push_back({"nothing new", [=](int) { return beside(stone, 0, plain); }});
  all.push_back({"the same quad redrawn", [=](int) -> std::vector<PlacedShape> {
                   *redrawn = makeShape(Model((*redrawn)->model), **redrawn);
                   return {placed(5, *redrawn, surfacesOf(*redrawn))};
                 }});
  all.push_back({"the same quad as another mesh", [=](int) -> std::vector<PlacedShape> {
                   const auto anew = makeShape(Model(floor->model));
                   return {placed(5, anew, surfacesOf(anew))};
                 }});
  all.push_back({"another object moved", [=](int frame) { return beside(stone, 1e-3 * frame, plain); }});
  all.push_back({"another object bent", [=](int frame) {
                   Model model = stone->model;
                   model.positions[0].y() -= 1e-3 * frame;
                   *bent = makeShape(std::move(model), **bent);
                   return beside(*bent, 0, plain);
                 }});
  all.push_back({"another object comes and goes", [=](int frame) {
                   return odd(frame) ? beside(stone, 0, plain) : std::vector<PlacedShape>{floor_there};
                 }});
  all.push_back({"another object's texture", [=](int frame) {
                   const float texel = odd(frame) ? 0.2F : 0.7F;
                   return beside(stone, 0, texturedSurfaces(Quantity::kDynamicFriction, 0, 1, texel));
                 }});
  all.push_back({"another object's material", [=](int frame) {
                   auto surfaces = std::make_shared<Surfaces>(*plain);
                   surfaces->materials[0].stiffness = odd(frame) ? 0.2 : 0.9;
                   return beside(stone, 0, surfaces);
                 }});
  all.push_back({"the floor's own texture, with the same texels", [=](int) -> std::vector<PlacedShape> {
                   return {placed(5, floor, texturedSurfaces(Quantity::kDynamicFriction, 0, 1, 0))};
                 }});
  return all;
}

TEST(ProxyLoop, WhatChangesNothingUnderTheFingerIsNoDrag) {
  constexpr double kSpeed_m_s = 0.06;
  for (const std::int64_t frame_ms : {5, 16}) {
    for (const Beside& beside : allBeside()) {
      std::vector<Instance> scene = followOn(beside.frame(0), {}, 0, 0).instances;
      Bench bench(scene);
      double x = -0.3;
      bench.run(100, {x, 0.01, 0.1});
      bench.run(100, {x, -0.003, 0.1});
      double drag_N = 0;
      for (int frame = 1; frame < 100; ++frame) {
        const std::int64_t begin_ns = bench.time_ns_ + kMs;
        Followed next =
            followOn(beside.frame(frame), pointersByKey(std::as_const(scene)), begin_ns, begin_ns + frame_ms * kMs);
        scene = next.instances;
        bench.publish(std::move(next.instances), next.blend_ns);
        for (int i = 0; i < frame_ms; ++i) {
          x += kSpeed_m_s * 1e-3;
          bench.run(1, {x, -0.003, 0.1});
          ASSERT_NEAR(bench.force_.y(), 5, 1e-6) << beside.what;
          drag_N = std::max(drag_N, bench.force_.head<1>().norm());
          ASSERT_EQ(bench.last_.report.contacts.size(), 1u);
        }
      }
      EXPECT_LT(drag_N / kSpeed_m_s, 1e-6) << "N s/m, " << beside.what << ", a frame each " << frame_ms << " ms";
    }
  }
}

TEST(ProxyLoop, FramesThatChangeNothingNearDoNotHoldUpWhatFades) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.005, 0});
  for (int frame = 0; frame < 12; ++frame) {
    bench.publish(frame % 2 == 1 ? std::vector<Instance>{} : std::vector<Instance>{floorAt(-1, 7)});
    EXPECT_LT(bench.run(5, {0, -0.005, 0}), kGentle_N);
  }
  EXPECT_EQ(bench.force_, Vec3::Zero()) << "60 ms after the floor has gone";
}

TEST(ProxyLoop, ASurfaceThatBecomesSofterPullsWithoutAJump) {
  Instance soft = floorAt(0);
  auto surfaces = std::make_shared<Surfaces>(*soft.surfaces);
  surfaces->materials[0].stiffness = 0.25;
  soft.surfaces = surfaces;
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.004, 0});
  EXPECT_NEAR(bench.force_.y(), 6, 1e-6);
  bench.publish({soft});
  EXPECT_LT(bench.run(60, {0, -0.004, 0}), kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 1.5, 1e-6);
  bench.publish({floorAt(0)});
  EXPECT_LT(bench.run(60, {0, -0.004, 0}), kGentle_N);
  EXPECT_NEAR(bench.force_.y(), 6, 1e-6);
}

TEST(ProxyLoop, ReportsWhatIsTouchedByTheNamesOfItsClient) {
  Bench bench({floorAt(0)});
  bench.run(5, {0, 0.01, 0});
  bench.run(5, {0, -0.001, 0});
  ASSERT_EQ(bench.last_.touched.size(), 1u);
  EXPECT_EQ(bench.last_.touched[0].object, 3u);
  bench.run(30, {0, 0.01, 0});
  TouchEvent event;
  ASSERT_TRUE(bench.loop_.popEvent(event));
  EXPECT_TRUE(event.touches);
  EXPECT_EQ(event.object.name, 9u);
  EXPECT_EQ(event.object.session, 2u);
  EXPECT_EQ(event.time_ns, 6 * kMs);
  ASSERT_TRUE(bench.loop_.popEvent(event));
  EXPECT_FALSE(event.touches);
  EXPECT_FALSE(bench.loop_.popEvent(event));
}

TEST(ProxyLoop, AnotherWorkspaceStartsTheProxyAnewWithoutAJump) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.run(10, {0, -0.005, 0});
  bench.commands_.workspace = {{0, 0.5, 0}, 10};
  ++bench.commands_.restarts;
  EXPECT_LT(bench.run(100, {0, -0.005, 0}), kGentle_N);
  EXPECT_EQ(bench.force_, Vec3::Zero()) << "0.45 m above the floor";
}

TEST(ProxyLoop, AllocatesNothing) {
  Bench bench({floorAt(0)});
  bench.run(1, {0, 0.01, 0});
  bench.publish({floorAt(0.001), floorAt(-1, 6)});
  const RealtimeGuard guard;
  bench.run(100, {0, -0.005, 0});
}

}  // namespace
}  // namespace hl::test_proxy_loop
