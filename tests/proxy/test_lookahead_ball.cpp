// A ball ahead of the proxy against a search for each step: the same ticks to the bit, the same impacts.
#include "proxy/lookahead_ball.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/scenes.h"
#include "judge.h"
#include "proxy/proxy.h"
#include "scene/snapshot.h"

namespace hl::test_lookahead_ball {
namespace {

constexpr double kRadius = 0.01;
constexpr double kTravel = 0.0015;  // of the finger in a tick

// Hills 0.4 m wide, of triangles with legs of `cell`.
Model hills(double cell) {
  const auto cells = static_cast<std::uint32_t>(std::lround(0.4 / cell));
  return judge::grid(cells, cells, [](double u, double v) {
    const double x = 0.4 * u - 0.2, y = 0.4 * v - 0.2;
    return Vec3(x, y, 0.03 * std::sin(17 * x) * std::cos(13 * y) + 0.004 * std::sin(90 * x + 40 * y));
  });
}

// A large floor, and on it a patch of small triangles: twice the square of `cells`.
Model floorWithPatch(std::uint32_t cells) {
  Model model = judge::triangles({{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 2, 0)}});
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  const Model patch = judge::grid(cells, cells, [](double u, double v) { return Vec3(0.06 * u, 0.06 * v, 1e-5); });
  model.positions.insert(model.positions.end(), patch.positions.begin(), patch.positions.end());
  for (const auto& t : patch.triangles) model.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return model;
}

bool hasBall(const ProxyState& state, const SceneAt& scene) {
  const Tolerances tolerance = Tolerances::of(kRadius, scene.extent());
  return state.cache.nearby.covers(scene, state.position, tolerance.touching) &&
         state.cache.nearby.slack_m(state.position, tolerance.touching) > 0;
}

// A finger that wanders at some depth below the hills, and now and then jumps, stops, or comes up.
class Wanderer {
 public:
  explicit Wanderer(test::Random& random) : random_(random) { jump(); }
  const Vec3& next() {
    if (random_.below(150) == 0) jump();
    if (random_.below(20) == 0) way_ = (way_ + 0.5 * random_.direction()).normalized();
    const double pace = random_.below(10) == 0 ? 0 : kTravel;
    finger_ += pace * Vec3(way_.x(), way_.y(), 0.2 * way_.z());
    if (finger_.head<2>().norm() > 0.18) way_ = -finger_.normalized();
    return finger_;
  }

 private:
  void jump() {
    finger_ = Vec3(random_.uniform(-0.15, 0.15), random_.uniform(-0.15, 0.15), random_.uniform(-0.06, 0.06));
    way_ = random_.direction();
  }

  test::Random& random_;
  Vec3 finger_ = Vec3::Zero(), way_ = Vec3::UnitX();
};

// The judge forgets before every tick what the last one met, and takes its finger for one that comes from far away, for
// which no ball is large enough. Without a budget, which the two use up at different places.
int ticksWithBall(const Snapshot& snapshot, ProxySettings settings, test::Random& random, int ticks) {
  settings.work_cap = kNoWorkCap;
  ProxyState a = startProxy(snapshot, settings, {0, 0, 0.1}), b = a;
  ManyRecentPrimitives recent;
  Wanderer wanderer(random);
  int with_ball = 0;
  for (int i = 0; i < ticks; ++i) {
    const Vec3& finger = wanderer.next();
    b.cache.nearby = SweepCache();
    b.cache.ahead.follow(Vec3::Constant(1e3));
    const TickReport lasting = tick(a, {snapshot, 0, recent}, settings, finger);
    const TickReport judged = tick(b, snapshot, settings, finger);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(lasting.target, judged.target);
    EXPECT_EQ(lasting.iterations, judged.iterations);
    EXPECT_EQ(lasting.contacts.size(), judged.contacts.size());
    if (testing::Test::HasFailure()) return 0;
    EXPECT_FALSE(hasBall(b, snapshot));
    with_ball += hasBall(a, snapshot);
  }
  return with_ball;
}

TEST(LookaheadBall, ATickWithABallIsATickThatSearchesToTheBit) {
  test::Random random(61);
  for (const HierarchyKind kind : {HierarchyKind::kBvh, HierarchyKind::kSpheres}) {
    const auto snapshot = judge::scene(hills(0.03), kind);
    ProxySettings settings{kRadius};
    EXPECT_GT(ticksWithBall(*snapshot, settings, random, 4000), 1500);
    settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.4;
    EXPECT_GT(ticksWithBall(*snapshot, settings, random, 4000), 1000);
  }
}

TEST(LookaheadBall, OfObjectsThatStandTurnedTheSame) {
  test::Random random(62);
  std::vector<Instance> instances(2);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    instances[i].shape = makeShape(hills(0.04));
    instances[i].surfaces = surfacesOf(instances[i].shape);
    instances[i].key = i + 1;
  }
  instances[1].motion =
      Motion({Eigen::AngleAxisd(0.7, Vec3(1, 2, 9).normalized()).toRotationMatrix(), Vec3(0.01, 0.02, -0.005)});
  EXPECT_GT(ticksWithBall(*makeSnapshot(instances), {kRadius}, random, 4000), 1000);
}

TEST(LookaheadBall, WhereTrianglesAreSmallThereIsNoBall) {
  test::Random random(63);
  EXPECT_EQ(ticksWithBall(*judge::scene(hills(0.003)), {kRadius}, random, 1000), 0);
}

// One primitive after the other, against all of them.
TEST(LookaheadBall, HoldAllThatTheWayCanTouch) {
  test::Random random(64);
  const auto snapshot = judge::scene(hills(0.03));
  const SceneAt scene(*snapshot);
  const Tolerances tolerance = Tolerances::of(kRadius, scene.extent());
  int found = 0, hits = 0;
  ProxyState state = startProxy(scene, {kRadius}, {0, 0, 0.1});
  Wanderer wanderer(random);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 finger = wanderer.next();
    tick(state, scene, {kRadius}, finger);
    ContactSet set;
    gatherContacts(scene, state.position, tolerance.touching, tolerance.reach, set);
    LookaheadBall ahead;
    ahead.follow(finger);
    ahead.follow(finger + kTravel * random.direction());
    Vec3 motion = random.uniform(0.2, 2) * kTravel * random.direction();
    for (const Contact& contact : set.contacts)
      motion -= std::min(0.0, motion.dot(contact.plane.normal)) * contact.plane.normal;
    SweepCache nearby;
    if (!ahead.find(scene, set, tolerance, state.position, motion, nearby)) continue;
    ++found;
    std::vector<PrimitiveId> near;
    nearby.forEach(state.position, state.position + motion, tolerance.touching + tolerance.skin, [&](PrimitiveId id) {
      const auto of = [&](const Contact& contact) { return contact.primitive == id; };
      if (std::none_of(set.contacts.begin(), set.contacts.end(), of) &&
          std::none_of(set.twins.begin(), set.twins.end(), of))
        near.push_back(id);
    });
    SceneImpact among, judged;
    const bool hit = scene.firstImpactAmong(near, state.position, motion, tolerance.swept, among);
    ASSERT_EQ(hit, scene.firstImpact(state.position, motion, tolerance.swept, tolerance.touching, judged));
    if (hit) {
      ++hits;
      ASSERT_EQ(among.impact.t, judged.impact.t);
      ASSERT_EQ(among.primitive, judged.primitive);
    }
    const Vec3 end = state.position + (hit ? among.impact.t : 1) * motion;
    ContactSet kept, searched;
    gatherContacts(scene, end, Vec3::Zero(), tolerance.touching, tolerance.reach, nearby, kept);
    gatherContacts(scene, end, tolerance.touching, tolerance.reach, searched);
    ASSERT_EQ(kept.contacts.size(), searched.contacts.size());
    for (std::size_t k = 0; k < kept.contacts.size(); ++k)
      ASSERT_TRUE(samePlane(kept.contacts[k], searched.contacts[k]));
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(hits, 20);
}

// A proxy that rests on the floor beside the patch, and slides toward it.
struct BesidePatch {
  explicit BesidePatch(std::uint32_t cells) : snapshot(judge::scene(floorWithPatch(cells))), scene(*snapshot) {
    gatherContacts(scene, from, tolerance.touching, tolerance.reach, set);
    ahead.follow({0, 0, 0});
    ahead.follow({kTravel, 0, 0});
  }
  bool find(SweepCache& nearby) { return ahead.find(scene, set, tolerance, from, Vec3(kTravel, 0, 0), nearby); }

  const std::shared_ptr<const Snapshot> snapshot;
  const SceneAt scene;
  const Tolerances tolerance = Tolerances::of(kRadius, scene.extent());
  const Vec3 from{-0.008, 0.03, tolerance.reach};
  ContactSet set;
  LookaheadBall ahead;
};

// On a large triangle among small ones the balls hold too much: soon nobody asks for them any more.
TEST(LookaheadBall, BallsThatHoldTooMuchAreTriedLessAndLess) {
  BesidePatch at(60);
  ASSERT_EQ(at.set.contacts.size(), 1u);
  int tried = 0;
  for (int i = 0; i < 1000; ++i) {
    SweepCache nearby;
    EXPECT_FALSE(at.find(nearby));
    tried += nearby.size() > 0;
  }
  EXPECT_GE(tried, 5);
  EXPECT_LE(tried, 10);
}

// A face of a machine part beside a rounded edge: the ball of the large triangle holds ten thousands of small ones.
TEST(LookaheadBall, TheSearchForABallThatHoldsTooMuchEndsSoon) {
  BesidePatch at(600);
  ASSERT_EQ(at.set.contacts.size(), 1u);
  const QueryCost before = at.scene.cost();
  SweepCache nearby;
  EXPECT_FALSE(at.find(nearby));
  EXPECT_LT(at.scene.cost().primitives - before.primitives, 4 * SweepCache::kRoom);
  EXPECT_LT(at.scene.cost().volumes - before.volumes, 4000u);
  const double slack = 0.5 * cost::kMaxBallTicks * kTravel;
  std::size_t within = 0;
  at.scene.primitivesWithin(at.from + Vec3(slack, 0, 0), at.tolerance.touching + slack,
                            [&](PrimitiveId, const ClosestPoint&) { ++within; });
  EXPECT_GT(within, 10'000u);
}

TEST(LookaheadBall, WhatMovesHasNone) {
  Instance instance;
  instance.shape = makeShape(hills(0.03));
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = Motion().then({Mat3::Identity(), Vec3(0, 0, -0.01)}, 0, 1'000'000'000);
  const auto snapshot = makeSnapshot({instance});
  const ProxySettings settings{kRadius};
  ProxyState state = startProxy({*snapshot, 0}, settings, {0, 0, 0.1});
  for (int i = 0; i < 200; ++i) {
    const std::int64_t time_ns = 1'000'000 * i;
    tick(state, {*snapshot, time_ns}, settings, {-0.1 + 0.001 * i, 0, -0.03});
    ASSERT_FALSE(hasBall(state, {*snapshot, time_ns}));
  }
  int with_ball = 0;  // and has one when it has come to rest
  for (int i = 0; i < 200; ++i) {
    const std::int64_t time_ns = 2'000'000'000 + std::int64_t{1'000'000} * i;
    tick(state, {*snapshot, time_ns}, settings, {0.1 - 0.001 * i, 0, -0.03});
    with_ball += hasBall(state, {*snapshot, time_ns});
  }
  EXPECT_GT(with_ball, 50);
}

}  // namespace
}  // namespace hl::test_lookahead_ball
