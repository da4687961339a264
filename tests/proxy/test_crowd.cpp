// A crowd: more planes touch the proxy at once than a set of contacts has room for. Those that the way goes into most
// hold it off; it is swept against the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/scenes.h"
#include "proxy/contacts.h"
#include "proxy/judge.h"
#include "proxy/proxy.h"

namespace hl::test_crowd {
namespace {

constexpr double kRadius = 1e-3;
constexpr std::uint32_t kSides = 1000;

// A funnel that opens to +z, its apex at the origin: on its axis the proxy touches all sides.
Model pit(std::uint32_t sides, double depth) {
  Model model;
  model.positions.push_back(Vec3::Zero());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    model.positions.emplace_back(0.02 * std::cos(angle), 0.02 * std::sin(angle), depth);
    model.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  return model;
}

// Where a proxy of this radius touches all sides of it.
Vec3 bottomOf(std::uint32_t sides, double depth) {
  const double inner = 0.02 * std::cos(M_PI / sides);  // the middle of a rim edge is so far from the axis
  return Vec3(0, 0, kRadius * std::hypot(inner, depth) / inner);
}

ProxySettings unlimited() {
  ProxySettings settings;
  settings.radius = kRadius;
  settings.work_cap = kNoWorkCap;
  return settings;
}

TEST(Crowd, ThoseStayThatTheWayGoesIntoMost) {
  const auto scene = judge::scene(pit(kSides, 0.01));
  const Tolerances tolerance = Tolerances::of(kRadius, SceneAt(*scene).extent());
  const Vec3 centre = bottomOf(kSides, 0.01);
  std::vector<Vec3> all;
  const SceneAt at(*scene);
  at.primitivesWithin(centre, tolerance.touching,
                      [&](PrimitiveId, const ClosestPoint& nearest) { all.push_back(nearest.normal); });
  ASSERT_EQ(all.size(), kSides);
  test::Random random(41);
  for (int i = 0; i < 20; ++i) {
    const Vec3 toward = 1e-3 * random.direction();
    SweepCache nearby;
    ContactSet set;
    gatherContacts(at, centre, toward, tolerance.touching, tolerance.reach, nearby, set);
    EXPECT_TRUE(set.crowd);
    ASSERT_EQ(set.contacts.size(), kMaxContacts);
    std::sort(all.begin(), all.end(), [&](const Vec3& a, const Vec3& b) { return a.dot(toward) < b.dot(toward); });
    for (const Contact& contact : set.contacts) {
      EXPECT_LE(contact.plane.normal.dot(toward), all[kMaxContacts - 1].dot(toward));
      EXPECT_TRUE(holdsBy(set, contact.plane));
    }
    EXPECT_FALSE(holdsBy(set, {all[kMaxContacts].normalized(), 1}));
  }
}

TEST(Crowd, TheOrderOfTheTrianglesDecidesNothing) {
  Model model = pit(kSides, 0.01), shuffled = model;
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), std::mt19937(3));
  const auto a = judge::scene(model), b = judge::scene(shuffled, HierarchyKind::kNone);
  ProxyState of_a = startProxy(*a, unlimited(), {0, 0, 0.02}), of_b = of_a;
  test::Random random(42);
  for (int i = 0; i < 200; ++i) {
    const Vec3 finger = 0.002 * random.inCube(1) + (i % 20 < 10 ? Vec3(0, 0, -0.005) : Vec3(0, 0, 0.004));
    tick(of_a, *a, unlimited(), finger);
    tick(of_b, *b, unlimited(), finger);
    ASSERT_EQ(of_a.position, of_b.position) << i;
  }
}

// The judge is the same pit of as many sides as there is room for.
TEST(Crowd, TheProxyGoesAlongAndLeavesWithTheFinger) {
  const auto many = judge::scene(pit(kSides, 0.01)), few = judge::scene(pit(50, 0.01));
  const ProxySettings settings;
  ProxyState crowded = startProxy(*many, settings, {0, 0, 0.02}), judged = startProxy(*few, settings, {0, 0, 0.02});
  for (int i = 0; i < 240; ++i) {
    const double t = i / 60.0;
    const Vec3 finger = t < 1   ? Vec3(0, 0, 0.02 - 0.03 * t)
                        : t < 2 ? Vec3(0.012 * (t - 1), 0, -0.01)
                                : Vec3(0.012, 0, -0.01 + 0.02 * (t - 2));
    tick(crowded, *many, settings, finger);
    tick(judged, *few, settings, finger);
    ASSERT_NEAR((crowded.position - judged.position).norm(), 0, 0.05 * kRadius) << i;
    ASSERT_GE(judge::clearance(*many, crowded.position, 2 * kRadius), kRadius * (1 - 1e-9)) << i;
  }
  EXPECT_EQ(crowded.position, Vec3(0.012, 0, -0.01 + 0.02 * (239 / 60.0 - 2)));
}

// With a finger at random, from still at the bottom to far off.
TEST(Crowd, NothingOfItIsPassed) {
  test::Random random(43);
  for (int scenes = 0; scenes < 20; ++scenes) {
    const double depth = 0.02 * std::pow(10.0, random.uniform(-2, 0.5));
    const auto scene = judge::scene(pit(100 + static_cast<std::uint32_t>(random.below(kSides)), depth));
    const ProxySettings settings;
    ProxyState state = startProxy(*scene, settings, {0, 0, depth + 0.01});
    int crowds = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec3 finger = Vec3(0, 0, -0.01) + std::pow(10.0, random.uniform(-9, -2)) * random.direction();
      crowds += tick(state, *scene, settings, finger).ending == Ending::kCrowded ? 1 : 0;
      ASSERT_GE(judge::clearance(*scene, state.position, 2 * kRadius), kRadius * (1 - 1e-9)) << i;
      ASSERT_GT(state.position.z(), 0) << i;
    }
    tick(state, *scene, settings, {0, 0, depth + 0.01});
    for (int i = 0; i < 100; ++i) tick(state, *scene, settings, {0, 0, depth + 0.01});
    EXPECT_EQ(state.position, Vec3(0, 0, depth + 0.01)) << "free again";
  }
}

// More triangles share the vertex than there is room for twins.
TEST(Crowd, TheOrderOfTrianglesAtAVertexDoesNotCount) {
  test::Random random(83);
  for (const double depth : {0.01, -0.01}) {
    const Model model = pit(400, depth);
    Model other = model;
    std::shuffle(other.triangles.begin(), other.triangles.end(), std::mt19937(7));
    const auto scene = judge::scene(model), shuffled = judge::scene(other, HierarchyKind::kNone);
    const Vec3 from(0, 0, depth > 0 ? -3 * kRadius : 3 * kRadius);
    ProxyState a = startProxy(*scene, unlimited(), from), b = startProxy(*shuffled, unlimited(), from);
    for (int i = 0; i < 20; ++i) {
      const Vec3 finger = 1e-2 * kRadius * random.direction();
      tick(a, *scene, unlimited(), finger);
      tick(b, *shuffled, unlimited(), finger);
      ASSERT_EQ(a.position, b.position) << depth << " " << i;
    }
  }
}

}  // namespace
}  // namespace hl::test_crowd
