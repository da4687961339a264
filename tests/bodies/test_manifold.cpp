// Manifolds of convex shapes.
#include <gtest/gtest.h>

#include "bodies/convex_hull.h"
#include "bodies/placed_bodies.h"
#include "draws.h"

namespace hl::test_manifold {
namespace {

struct PlacedShape {
  PlacedShape(const Convex& shape, const Vec3& centre,
              const Eigen::Quaterniond& turned = Eigen::Quaterniond::Identity()) {
    body.shape = shape;
    BodyState state;
    state.centre = centre;
    state.turned = turned;
    at = placed(body.shape.parts[0], state, room);
  }
  Body body;
  PlacedRoom room;
  PlacedConvex at;
};

TEST(Manifold, ABoxOnABoxHasFourPoints) {
  const Convex shape = boxShape(Vec3(0.1, 0.1, 0.1));
  const PlacedShape a(shape, Vec3(0.01, 0.2001, 0)), b(shape, Vec3::Zero());
  Manifold found;
  ASSERT_TRUE(findManifold(a.at, b.at, 0.01, found));
  EXPECT_EQ(found.points.size(), 4u);
  EXPECT_LT((found.normal - Vec3::UnitY()).norm(), 1e-12);
  for (const ManifoldPoint& point : found.points) EXPECT_NEAR(point.gap, 1e-4, 1e-12);
  EXPECT_FALSE(findManifold(a.at, b.at, 1e-5, found));
}

TEST(Manifold, CrossedEdgesHaveOnePoint) {
  const Convex shape = boxShape(Vec3(0.1, 0.1, 0.1));
  const Eigen::Quaterniond about_x(Eigen::AngleAxisd(0.25 * 3.14159265358979, Vec3::UnitX()));
  const Eigen::Quaterniond about_z(Eigen::AngleAxisd(0.25 * 3.14159265358979, Vec3::UnitZ()));
  const double half = 0.1 * std::sqrt(2.0);
  const PlacedShape a(shape, Vec3(0, 2 * half + 0.001, 0), about_x), b(shape, Vec3::Zero(), about_z);
  Manifold found;
  ASSERT_TRUE(findManifold(a.at, b.at, 0.01, found));
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_NEAR(found.points[0].gap, 0.001, 1e-9);
  EXPECT_LT((found.normal - Vec3::UnitY()).norm(), 1e-9);
}

// Of what has long and short faces side by side, the face that is turned most toward another shape may not have the
// corner that is deepest in it.
TEST(Manifold, OfAnyHullOnAFaceHasItsLowestCorner) {
  test::Draws draws(5);
  const PlacedShape b(boxShape(Vec3(1, 0.1, 1)), Vec3(0, -0.1, 0));
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec3> points;
    for (int k = 0; k < 4 + i % 12; ++k)
      points.emplace_back(draws.between(0.5, 1) * Vec3(0.002, 0.004, 0.02).cwiseProduct(draws.direction()));
    const Convex shape = moved(hullOf(points).shape, Vec3::Zero());
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(draws.between(0, 3), draws.direction()));
    double lowest = 1;
    for (const Vec3& vertex : shape.vertices) lowest = std::min(lowest, (turned * vertex).y());
    const double gap = draws.between(-1e-4, 1e-4);
    const PlacedShape a(shape, Vec3(0, gap - lowest, 0), turned);
    Manifold found;
    ASSERT_TRUE(findManifold(a.at, b.at, 2e-4, found)) << i;
    double least = 1;
    for (const ManifoldPoint& point : found.points) least = std::min(least, point.gap);
    ASSERT_NEAR(least, gap, 1e-9) << i;
  }
}

// It overlaps least where its edges pass that of the box, but is borne by its corners too.
TEST(Manifold, APlateThatLiesNearlyFlatOverAnEdgeIsBorneByAllOfIt) {
  constexpr double kTilt_rad = 7e-6, kDeep_m = 1.5e-7;
  const Eigen::Quaterniond about_y(Eigen::AngleAxisd(0.8, Vec3::UnitY()));
  const PlacedShape b(boxShape(Vec3(1, 0.1, 1)), Vec3(1, -0.1, 0));  // its edge is the z axis
  for (int i = 0; i < 16; ++i) {
    const double angle = i * EIGEN_PI / 8;
    const Eigen::Quaterniond tilt(Eigen::AngleAxisd(kTilt_rad, Vec3(std::cos(angle), 0, std::sin(angle))));
    const PlacedShape a(boxShape(Vec3(0.02, 1e-5, 0.02)), Vec3(0.001, 1e-5 - kDeep_m, 0), tilt * about_y);
    Manifold found;
    ASSERT_TRUE(findManifold(a.at, b.at, 1e-6, found)) << i;
    EXPECT_GE(found.points.size(), 4u) << i;
    EXPECT_LT((found.normal - Vec3::UnitY()).norm(), 1e-5) << i;
  }
}

TEST(Manifold, CornersThatAreApartMeetAlongTheLineBetweenThem) {
  const Convex shape = boxShape(Vec3(0.1, 0.1, 0.1));
  const PlacedShape a(shape, Vec3(0.201, 0.202, 0.202)), b(shape, Vec3::Zero());
  Manifold found;
  ASSERT_TRUE(findManifold(a.at, b.at, 0.01, found));
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_NEAR(found.points[0].gap, 0.003, 1e-12);
  EXPECT_LT((found.normal - Vec3(1, 2, 2) / 3).norm(), 1e-9);
}

TEST(Manifold, ACapsuleLiesOnABoxWithTwoPoints) {
  const PlacedShape a(capsuleShape(0.05, 0.01), Vec3(0, 0.11, 0)), b(boxShape(Vec3(0.1, 0.1, 0.1)), Vec3::Zero());
  Manifold found;
  ASSERT_TRUE(findManifold(a.at, b.at, 0.001, found));
  EXPECT_EQ(found.points.size(), 2u);
  for (const ManifoldPoint& point : found.points) EXPECT_NEAR(point.gap, 0, 1e-12);
}

// m, from a box at the origin; < 0 within.
double heightOver(const Vec3& half, const Vec3& point) {
  const Vec3 beyond = point.cwiseAbs() - half;
  return beyond.maxCoeff() > 0 ? beyond.cwiseMax(0.0).norm() : beyond.maxCoeff();
}

// The least along a segment, on which the height is convex: each time a third of it is left out.
double heightOver(const Vec3& half, Vec3 begin, Vec3 end) {
  for (int i = 0; i < 100; ++i) {
    const Vec3 one = begin + (end - begin) / 3, other = end - (end - begin) / 3;
    if (heightOver(half, one) < heightOver(half, other))
      end = other;
    else
      begin = one;
  }
  return heightOver(half, begin);
}

TEST(Manifold, ACapsuleMeetsABoxAsNearAsItIs) {
  test::Draws draws(1);
  int near = 0;
  while (near < 3000) {
    const Vec3 half(draws.between(0.005, 0.04), draws.between(0.005, 0.04), draws.between(0.005, 0.04));
    const double half_length = draws.between(0.004, 0.05), radius = draws.between(0.002, 0.015);
    const Vec3 at = half.norm() * draws.between(0.5, 2.5) * draws.direction(), along = draws.direction();
    const double gap = heightOver(half, at - half_length * along, at + half_length * along) - radius;
    if (std::abs(gap) > 5e-4) continue;
    ++near;
    const PlacedShape a(capsuleShape(half_length, radius), at,
                        Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), along));
    const PlacedShape b(boxShape(half), Vec3::Zero());
    Manifold found;
    ASSERT_TRUE(findManifold(a.at, b.at, 1e-3, found));
    double least = 1;
    for (const ManifoldPoint& point : found.points) least = std::min(least, point.gap);
    EXPECT_NEAR(least, gap, 1e-5) << near;
  }
}

}  // namespace
}  // namespace hl::test_manifold
