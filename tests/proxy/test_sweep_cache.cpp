// What a sweep meets on its way against a search where it ends, and ticks that remember against ticks that do not.
#include "proxy/sweep_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "effect_scenes.h"
#include "geometry/scenes.h"
#include "judge.h"
#include "proxy/contacts.h"
#include "proxy/tolerances.h"

namespace hl::test_sweep_cache {
namespace {

constexpr double kRadius = 0.01;

std::shared_ptr<const Snapshot> randomScene(test::Random& random, int objects, int triangles, HierarchyKind kind) {
  std::vector<Instance> instances;
  for (int k = 0; k < objects; ++k) {
    std::vector<std::array<Vec3, 3>> soup;
    for (int i = 0; i < triangles; ++i) {
      const Vec3 a = random.inCube(0.1);
      soup.push_back({a, a + random.inCube(0.03), a + random.inCube(0.03)});
    }
    Instance instance;
    instance.shape = makeShape(judge::triangles(soup), kind);
    instance.surfaces = surfacesOf(instance.shape);
    instance.key = static_cast<std::uint64_t>(k);
    if (k > 0)
      instance.motion =
          Motion({Eigen::AngleAxisd(random.uniform(0, 3), random.direction()).toRotationMatrix(), random.inCube(0.02)});
    instances.push_back(instance);
  }
  return makeSnapshot(instances);
}

void expectSame(const ContactSet& a, const ContactSet& b) {
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  ASSERT_EQ(a.twins.size(), b.twins.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    ASSERT_TRUE(samePlane(a.contacts[i], b.contacts[i]));
    ASSERT_EQ(a.contacts[i].primitive, b.contacts[i].primitive);
    ASSERT_EQ(a.contacts[i].point, b.contacts[i].point);
  }
}

// From a place in contact or clear, with the contacts known, to the first impact or the end of the way.
TEST(SweepCache, HoldsTheContactsOfThePlaceWhereASweepEnds) {
  test::Random random(21);
  int stopped = 0, touched = 0;
  for (const HierarchyKind kind : {HierarchyKind::kBvh, HierarchyKind::kSpheres}) {
    for (int round = 0; round < 400; ++round) {
      const auto snapshot = randomScene(random, 1 + random.below(3), 30, kind);
      const SceneAt scene(*snapshot);
      const Tolerances tolerance = Tolerances::of(kRadius, scene.extent());
      ProxyState state = startProxy(scene, {kRadius}, random.inCube(0.12));
      if (!state.free) continue;
      Vec3 place = state.position;
      for (int step = 0; step < 6; ++step) {
        ContactSet here, found, searched;
        gatherContacts(scene, place, tolerance.touching, tolerance.reach, here);
        FixedVector<PrimitiveId, cost::kKnownRoom> contacts;
        ASSERT_TRUE(primitivesOf(here, contacts));
        Vec3 motion = random.inCube(0.1);
        for (const Contact& contact : here.contacts)
          motion -= std::min(0.0, motion.dot(contact.plane.normal)) * contact.plane.normal;
        SweepCache nearby;
        nearby.begin(scene, tolerance.touching);
        SceneImpact impact, judged;
        const bool hit = scene.firstImpact(
            place, motion, tolerance.swept, tolerance.touching, 0.01, {contacts.begin(), contacts.size()},
            [&](PrimitiveId primitive) { nearby.add(primitive); }, impact);
        ASSERT_EQ(hit, scene.firstImpact(place, motion, tolerance.swept, tolerance.touching, judged));
        if (hit) {
          ASSERT_EQ(impact.impact.t, judged.impact.t);
          ASSERT_EQ(impact.primitive, judged.primitive);
        }
        place += (hit ? impact.impact.t : 1) * motion;
        nearby.endAt(place);
        ASSERT_TRUE(nearby.covers(scene, place, tolerance.touching));
        gatherContacts(scene, place, Vec3::Zero(), tolerance.touching, tolerance.reach, nearby, found);
        gatherContacts(scene, place, tolerance.touching, tolerance.reach, searched);
        expectSame(found, searched);
        stopped += hit;
        touched += !searched.contacts.empty();
      }
    }
  }
  EXPECT_GT(stopped, 500);
  EXPECT_GT(touched, 500);
}

TEST(SweepCache, CoversNothingOfAnotherPlaceSceneOrTime) {
  test::Random random(22);
  const auto snapshot = randomScene(random, 2, 5, HierarchyKind::kBvh);
  const auto other = makeSnapshot(snapshot->instances);
  std::vector<Instance> moving = snapshot->instances;
  moving[1].motion = moving[1].motion.then({}, 0, 100);
  const auto moves = makeSnapshot(moving);
  const Vec3 place(0.01, 0.02, 0.03);
  const auto nearbyAt = [&](const SceneAt& scene) {
    SweepCache nearby;
    ContactSet set;
    gatherContacts(scene, place, Vec3::Zero(), kRadius, kRadius, nearby, set);
    return nearby;
  };
  EXPECT_FALSE(SweepCache().covers(*snapshot, Vec3::Zero(), 0));
  const SweepCache at_rest = nearbyAt({*snapshot, 5});
  EXPECT_TRUE(at_rest.covers({*snapshot, 5}, place, kRadius));
  EXPECT_TRUE(at_rest.covers({*snapshot, 6}, place, kRadius));
  EXPECT_FALSE(at_rest.covers({*snapshot, 5}, place + Vec3(0, 0, 1e-17 + 1e-16), kRadius));
  EXPECT_FALSE(at_rest.covers({*snapshot, 5}, place, 2 * kRadius));
  EXPECT_FALSE(at_rest.covers({*other, 5}, place, kRadius));
  const SweepCache on_the_way = nearbyAt({*moves, 50});
  EXPECT_TRUE(on_the_way.covers({*moves, 50}, place, kRadius));
  EXPECT_FALSE(on_the_way.covers({*moves, 51}, place, kRadius));
  EXPECT_FALSE(on_the_way.covers({*moves, 200}, place, kRadius));
  EXPECT_TRUE(nearbyAt({*moves, 100}).covers({*moves, 200}, place, kRadius));
}

TEST(SweepCache, MoreThanItHasRoomForIsNotCovered) {
  std::vector<std::array<Vec3, 3>> fan;
  constexpr int kFaces = SweepCache::kRoom + 8;
  for (int i = 0; i < kFaces; ++i) {
    const double a = 2 * M_PI * i / kFaces, b = 2 * M_PI * (i + 1) / kFaces;
    fan.push_back({Vec3::Zero(), {std::cos(a), std::sin(a), -1}, {std::cos(b), std::sin(b), -1}});
  }
  const auto snapshot = judge::scene(judge::triangles(fan));
  const ProxySettings settings{kRadius};
  ProxyState state = startProxy(*snapshot, settings, {0, 0, 0.05});
  for (int i = 0; i < 5; ++i) {
    const TickReport report = tick(state, *snapshot, settings, {0, 0, -0.05 - 0.001 * i});
    EXPECT_FALSE(report.capped());
    EXPECT_NEAR(state.position.z(), kRadius, 1e-6);
  }
  // A place on the tip touches all of them.
  const Tolerances tolerance = Tolerances::of(kRadius, 1);
  SweepCache nearby;
  ContactSet set;
  gatherContacts(*snapshot, state.position, Vec3::Zero(), tolerance.touching, tolerance.reach, nearby, set);
  EXPECT_FALSE(nearby.covers(*snapshot, state.position, tolerance.touching));
}

// The judge forgets before every tick what the last one met.
TEST(SweepCache, ATickThatRemembersIsATickThatSearchesToTheBit) {
  test::Random random(23);
  ManyRecentPrimitives recent;  // of one scene after the other
  for (int round = 0; round < 60; ++round) {
    const auto snapshot = randomScene(random, 2, 20, HierarchyKind::kBvh);
    ProxySettings settings{kRadius};
    if (round % 2 == 1) settings.surfaces.static_friction = settings.surfaces.dynamic_friction = 0.4;
    ProxyState a = startProxy(*snapshot, settings, random.inCube(0.12)), b = a;
    Vec3 finger = a.position;
    for (int i = 0; i < 200; ++i) {
      finger = random.below(30) == 0 ? random.inCube(0.12) : Vec3(finger + random.inCube(0.004));
      b.cache.nearby = SweepCache();
      const TickReport remembered = tick(a, {*snapshot, 0, recent}, settings, finger),
                       searched = tick(b, *snapshot, settings, finger);
      ASSERT_EQ(a.position, b.position);
      ASSERT_EQ(remembered.target, searched.target);
      ASSERT_EQ(remembered.iterations, searched.iterations);
      ASSERT_EQ(remembered.contacts.size(), searched.contacts.size());
    }
  }
}

}  // namespace
}  // namespace hl::test_sweep_cache
