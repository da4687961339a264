// What a cloud keeps of its points, and the planes and surfels that it makes of them.
#include "surfaces/cloud_maker.h"
#include "surfaces/point_cloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/error.h"
#include "builtin.h"
#include "clouds.h"
#include "surfaces/cloud_search.h"

namespace hl::test_point_cloud {
namespace {

using test::Random;

std::vector<std::size_t> slotsOf(const CloudPoints& points) {
  std::vector<std::size_t> slots;
  for (std::size_t block = 0; block < points.blocks(); ++block) {
    for (std::size_t i = 0; i < points.countIn(block); ++i) slots.push_back(block * CloudPoints::kPerBlock + i);
  }
  return slots;
}

TEST(PackedNormal, ComesBackWithinItsError) {
  Random random(1);
  for (int i = 0; i < 100'000; ++i) {
    Vec3 n = random.direction();
    if (i % 10 == 0) n = n.array().round().matrix().normalized();
    if (!n.allFinite()) continue;
    const Vec3 back = unpackNormal(packNormal(3 * n));
    ASSERT_LT(back.cross(n).norm(), kPackedNormalError_rad);
    ASSERT_GT(back.dot(n), 0);
  }
  EXPECT_EQ(packNormal(Vec3::Zero()), kNoNormal);
  EXPECT_EQ(packNormal(Vec3(NAN, 0, 1)), kNoNormal);
}

// As a laser scanner's file: int32 steps of 1 mm, some points far out.
TEST(CloudPoints, ALatticeIsKeptWithoutLoss) {
  Random random(2);
  CloudInput input;
  input.lattice = {Vec3(0.001, 0.001, 0.0005), Vec3(4e5, 100, -5e6)};
  input.exact = true;
  std::set<std::array<std::int32_t, 3>> given;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 at = 1e4 * random.inCube(1);
    std::array<std::int32_t, 3> steps{static_cast<std::int32_t>(at.x()), static_cast<std::int32_t>(at.y()), 7};
    if (i % 500 == 0) steps[2] = i % 1000 == 0 ? 2147483647 : -2147483647 - 1;
    given.insert(steps);
    input.points.push_back({steps, kNoNormal});
    if (i % 10 == 0) input.points.push_back({steps, kNoNormal});
  }
  const auto points = makeCloud(input);
  EXPECT_EQ(points->error_m(), 0);
  EXPECT_EQ(points->size(), given.size());
  std::set<std::array<std::int32_t, 3>> kept;
  for (const std::size_t slot : slotsOf(*points)) kept.insert(points->stepsAt(slot));
  EXPECT_EQ(kept, given);
}

// Small clouds are not rounded to what 16 bits of a block of neighbours keep, however far apart their points are.
TEST(CloudPoints, PointsStayWithinTheStatedError) {
  Random random(3);
  for (const auto& [count, radius_m] : {std::pair{3000, 0.1}, {16, 10.0}, {40, 1e3}, {20'000, 0.1}}) {
    std::vector<Vec3> given;
    for (int i = 0; i < count; ++i) given.emplace_back(Vec3(3, 4, 5) + radius_m * random.direction());
    const auto points = test::cloudOf(given);
    const PointCloud cloud(points, CloudLook{});
    EXPECT_LT(points->error_m(), count > 10'000 ? 1e-3 * points->usualSpacing() : 2e-9 * radius_m) << count;
    for (std::size_t i = 0; i < std::min<std::size_t>(100, given.size()); ++i) {
      double nearest = radius_m;
      for (const std::size_t slot : slotsOf(*points))
        nearest = std::min(nearest, (cloud.corners(slot)[0] - given[i]).norm());
      ASSERT_LE(nearest, points->error_m()) << count;
    }
  }
}

TEST(CloudPoints, OrderAndSecondMakingChangeNothing) {
  Random random(4);
  std::vector<Vec3> given;
  for (int i = 0; i < 4000; ++i) given.push_back(random.inCube(1));
  const auto one = test::cloudOf(given);
  std::reverse(given.begin(), given.end());
  const auto other = test::cloudOf(given);
  CloudInput again;
  again.lattice = one->lattice();
  again.exact = again.made_before = true;
  for (const std::size_t slot : slotsOf(*other)) again.points.push_back({other->stepsAt(slot), other->normal(slot)});
  const auto third = makeCloud(again);
  ASSERT_EQ(slotsOf(*one), slotsOf(*other));
  ASSERT_EQ(slotsOf(*one), slotsOf(*third));
  for (const std::size_t slot : slotsOf(*one)) {
    ASSERT_EQ(one->at(slot), other->at(slot));
    ASSERT_EQ(one->at(slot), third->at(slot));
    ASSERT_EQ(one->normal(slot), third->normal(slot));
    ASSERT_EQ(one->spacing(slot / CloudPoints::kPerBlock), third->spacing(slot / CloudPoints::kPerBlock));
  }
}

TEST(CloudPoints, TheNearestPointsAreThoseOfAllPoints) {
  Random random(5);
  for (int n : {1, 2, 12, 13, 14, 1000}) {
    std::vector<Vec3> given;
    for (int i = 0; i < n; ++i) given.push_back(random.inCube(1));
    const auto points = test::cloudOf(given);
    const CloudSearch search(*points);
    const std::vector<std::size_t> slots = slotsOf(*points);
    for (std::size_t i = 0; i < slots.size(); i += 1 + slots.size() / 50) {
      std::vector<double> square;
      const Vec3& step = points->lattice().step;
      for (const std::size_t other : slots)
        square.push_back(step.cwiseProduct(points->at(other) - points->at(slots[i])).squaredNorm());
      std::sort(square.begin(), square.end());
      const CloudNeighbours nearest = search.around(slots[i]);
      ASSERT_EQ(nearest.size(), std::min<std::size_t>(slots.size(), CloudNeighbours::kNeighbours + 1));
      ASSERT_NEAR(nearest.farthest(), square[nearest.size() - 1], 1e-12);
      const std::size_t block = slots[i] / CloudPoints::kPerBlock;
      ASSERT_EQ(search.aroundAll(block)[slots[i] % CloudPoints::kPerBlock].farthest(), nearest.farthest());
    }
  }
}

TEST(CloudPoints, NormalsAreThoseOfThePlaneAndSpacingThatOfTheGrid) {
  const double spacing = 0.25e-3;
  const auto points = test::cloudOf(test::squareGrid(60, spacing));
  EXPECT_NEAR(points->usualSpacing(), spacing, 0.05 * spacing);
  for (const std::size_t slot : slotsOf(*points))
    ASSERT_LT(unpackNormal(points->normal(slot)).cross(Vec3::UnitY()).norm(), kPackedNormalError_rad);
}

TEST(CloudPoints, NormalsOfASphere) {
  Random random(6);
  std::vector<Vec3> given;
  for (int i = 0; i < 20'000; ++i) given.emplace_back(0.05 * random.direction());
  const auto points = test::cloudOf(given);
  const PointCloud cloud(points, CloudLook{});
  double worst = 0;
  for (const std::size_t slot : slotsOf(*points))
    worst = std::max(worst, cloud.trueNormal(slot, {}).cross(cloud.corners(slot)[0].normalized()).norm());
  EXPECT_LT(worst, 0.06);
}

TEST(CloudPoints, GivenNormalsAreKept) {
  const std::vector<Vec3> given = test::squareGrid(20, 1e-3);
  const Vec3 n = Vec3(1, 2, 3).normalized();
  const auto points = test::cloudOf(given, std::vector<std::uint32_t>(given.size(), packNormal(n)));
  for (const std::size_t slot : slotsOf(*points)) ASSERT_EQ(points->normal(slot), packNormal(n));
}

TEST(CloudPoints, TakeAsManyBytesAsTheirBlocksNeed) {
  const auto bytes = [](const CloudPoints& points) {
    return static_cast<double>(points.bytes()) / static_cast<double>(points.size());
  };
  EXPECT_LT(bytes(*test::cloudOf(test::squareGrid(350, 1e-3))), 6.5);
  const SceneModel terrain = makeBuiltinWorld("points:terrain:100000");
  EXPECT_LT(bytes(*dynamic_cast<const PointCloud&>(*terrain.surfaces[0].source).points()), 10.9);
  // Without any order: 16 bits along each axis, and all 32 of a normal.
  Random random(8);
  std::vector<Vec3> given;
  std::vector<std::uint32_t> normals;
  for (int i = 0; i < 100'000; ++i) {
    given.push_back(random.inCube(1));
    normals.push_back(packNormal(random.direction()));
  }
  EXPECT_LT(bytes(*test::cloudOf(given, normals)), 12.3);
}

// Also where the lattice becomes coarser, and in whatever order the points come.
TEST(CloudPoints, ColoursAreThoseOfTheNearestPointsThatWereGiven) {
  Random random(5);
  for (const auto& [count, far] : {std::pair{2000, 1.0}, {20'000, 1e4}}) {
    std::vector<Vec3> given;
    std::vector<Rgb> colours;
    for (int i = 0; i < count; ++i) {
      given.push_back(random.inCube(i == 0 ? far : 1));
      const auto part = [&] { return static_cast<std::uint8_t>(random.below(256)); };
      colours.push_back({part(), part(), part()});
    }
    std::size_t skipped = 0;
    const auto points = makeCloud(onFineLattice(given, {}, skipped, colours));
    ASSERT_TRUE(points->hasColours());
    const PointCloud cloud(points, CloudLook{});
    for (const std::size_t slot : slotsOf(*points)) {
      if (count > 2000 && slot % 200 > 10) continue;  // each is held against all
      const Vec3 at = cloud.corners(slot)[0];
      const auto nearest = std::min_element(given.begin(), given.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - at).squaredNorm() < (b - at).squaredNorm();
      });
      ASSERT_EQ(points->colour(slot), colours[static_cast<std::size_t>(nearest - given.begin())]) << slot;
    }
    std::reverse(given.begin(), given.end());
    std::reverse(colours.begin(), colours.end());
    const auto other = makeCloud(onFineLattice(given, {}, skipped, colours));
    for (const std::size_t slot : slotsOf(*points)) ASSERT_EQ(points->colour(slot), other->colour(slot));
  }
}

TEST(CloudPoints, OfTwoColoursAtOnePlaceTheOrderDoesNotDecide) {
  const std::vector<Vec3> twice(2, Vec3(1, 2, 3));
  std::size_t skipped = 0;
  const auto one = makeCloud(onFineLattice(twice, {}, skipped, {{9, 0, 0}, {8, 255, 255}}));
  const auto other = makeCloud(onFineLattice(twice, {}, skipped, {{8, 255, 255}, {9, 0, 0}}));
  EXPECT_EQ(one->size(), 1U);
  EXPECT_EQ(one->colour(0), other->colour(0));
}

TEST(CloudPoints, ColoursTakeThreeBytesEach) {
  const std::vector<Vec3> given = test::squareGrid(352, 1e-3);  // whole blocks
  std::size_t skipped = 0;
  const auto plain = test::cloudOf(given);
  const auto coloured = makeCloud(onFineLattice(given, {}, skipped, std::vector<Rgb>(given.size())));
  EXPECT_FALSE(plain->hasColours());
  EXPECT_LE(coloured->bytes() - plain->bytes(), 3 * given.size() * 11 / 10);
}

// A grid of 1 mm: steps of 1e8 m / 2^30 make all of it one point.
TEST(CloudPoints, AStrayPointThatMergesTheOthersIsNamed) {
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 50; ++j) points.emplace_back(1e-3 * i, 1e-3 * j, 0);
  }
  for (const double far : {1.0, 1e3, 1e5}) {
    std::vector<Vec3> with = points;
    with.emplace_back(far, 0, 0);
    EXPECT_EQ(test::cloudOf(with)->size(), with.size()) << far;
  }
  points.emplace_back(1e8, 0, 0);
  try {
    test::cloudOf(points);
    ADD_FAILURE() << "it was made";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the point 1e+08 0 0 lies so far"), std::string::npos) << error.what();
  }
}

TEST(CloudPoints, NoneOrFarOnesAreRefused) {
  EXPECT_THROW(test::cloudOf({}), Error);
  EXPECT_THROW(test::cloudOf({Vec3::Constant(NAN)}), Error);
  EXPECT_THROW(test::cloudOf({Vec3(2e9, 0, 0)}), Error);
  EXPECT_THROW(PointCloud(test::cloudOf({Vec3::Zero()}), CloudLook{CloudForm::kSurfels, 0}), Error);
  EXPECT_EQ(test::cloudOf({Vec3(1, 2, 3), Vec3::Constant(NAN), Vec3(1, 2, 3)})->size(), 1U);
}

TEST(PointCloud, SurfelsHaveTrianglesAtAllScales) {
  Random random(7);
  for (int scene = 0; scene < 300; ++scene) {
    const auto cloud = test::randomCloud(random);
    if (!cloud->surfels()) continue;
    for (const std::size_t slot : slotsOf(*cloud->points())) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto [a, b, c] = cloud->corners(4 * slot + i);
        ASSERT_TRUE(isTriangle(a, b, c));
        const Vec3 side = (b - a).cross(c - a).normalized();
        ASSERT_GT(side.dot(cloud->trueNormal(4 * slot + i, a)), 0.99);
        ASSERT_LE((a - b).norm(), 2 * cloud->cloud().reachOf(slot / CloudPoints::kPerBlock) * (1 + 1e-5));
      }
    }
  }
}

TEST(PointCloud, WhatIsDrawnIsThinned) {
  const auto points = test::cloudOf(test::squareGrid(100, 1e-3));
  const PointCloud bare(points, CloudLook{}), surfels(points, CloudLook{CloudForm::kSurfels});
  EXPECT_EQ(bare.drawn(1'000'000).triangles.size(), 40'000U);
  EXPECT_LT((bare.drawn(1000).positions[0] - bare.drawn(1000).positions[3]).norm(),
            (surfels.drawn(1000).positions[0] - surfels.drawn(1000).positions[3]).norm());
  EXPECT_EQ(surfels.drawn(1'000'000).triangles.size(), 40'000U);
  EXPECT_LE(surfels.drawn(1000).triangles.size(), 1000U);
  EXPECT_TRUE(surfels.drawn(1000).colours.empty());
}

TEST(PointCloud, WhatIsDrawnHasTheColourOfItsPoint) {
  const std::vector<Vec3> given{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Rgb> colours{{1, 2, 3}, {40, 50, 60}, {255, 0, 128}};
  std::size_t skipped = 0;
  const PointCloud cloud(makeCloud(onFineLattice(given, {}, skipped, colours)), CloudLook{});
  const DrawnMesh drawn = cloud.drawn(1000);
  ASSERT_EQ(drawn.colours.size(), drawn.positions.size());
  for (std::size_t first = 0; first < drawn.positions.size(); first += PlacedCloud::kSides) {
    double x = 0;  // of the middle of a disc
    for (std::size_t i = 0; i < PlacedCloud::kSides; ++i) x += drawn.positions[first + i].x() / PlacedCloud::kSides;
    for (std::size_t i = 0; i < PlacedCloud::kSides; ++i)
      EXPECT_EQ(drawn.colours[first + i], colours[static_cast<std::size_t>(std::lround(x))]);
  }
}

}  // namespace
}  // namespace hl::test_point_cloud
