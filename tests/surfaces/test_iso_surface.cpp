// Iso surfaces: closed where they should be, exact where interpolation is, and near to what was sampled.
#include "surfaces/iso_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "volumes.h"

namespace hl::test_iso_surface {
namespace {

using test::Random;

// How often each side of a triangle occurs, by the bits of its ends, less how often it occurs the other way round.
struct SideUse {
  int count = 0, balance = 0;
};
using SideUses = std::map<std::array<double, 6>, SideUse>;

SideUses sidesOf(const IsoSurface& surface, const IsoCell& cell) {
  SideUses sides;
  if (cell.triangles == nullptr) return sides;
  for (unsigned n = 0; n < cell.triangles->count; ++n) {
    if (!exists(cell, n)) continue;
    const std::array<Vec3, 3> corner = surface.corners(surface.cells().idOf(cell, n));
    EXPECT_TRUE(isTriangle(corner[0], corner[1], corner[2]));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = corner[i], &b = corner[(i + 1) % 3];
      const bool forward = std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
      const Vec3 &low = forward ? a : b, &high = forward ? b : a;
      SideUse& use = sides[{low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}];
      ++use.count;
      use.balance += forward ? 1 : -1;
    }
  }
  return sides;
}

void add(SideUses& to, const SideUses& from) {
  for (const auto& [side, use] : from) {
    to[side].count += use.count;
    to[side].balance += use.balance;
  }
}

// Random values in blocks of 3^3 cells: each side of a triangle in the middle cell has one other, with the opposite
// direction, and all bits are the same.
TEST(IsoSurface, EachInnerSideBelongsToTwoTriangles) {
  Random random(1);
  const int blocks = 100'000 * test::longer();
  std::size_t checked = 0;
  for (int i = 0; i < blocks; ++i) {
    const auto volume = test::volumeOf({4, 4, 4}, [&](const Vec3&) { return random.uniform(-1, 1); });
    const IsoSurface surface(volume, test::cubicFrame(1e-3, random.inCube(1)), {0.1, SolidSide::kAbove});
    SideUses all;
    for (std::uint32_t c = 0; c < 27; ++c) add(all, sidesOf(surface, surface.cells().at({c % 3, c / 3 % 3, c / 9})));
    for (const auto& [side, use] : sidesOf(surface, surface.cells().at({1, 1, 1}))) {
      ASSERT_EQ(all[side].count, 2) << "block " << i;
      ASSERT_EQ(all[side].balance, 0) << "block " << i;
      ++checked;
    }
  }
  EXPECT_GT(checked, 500'000U);
}

// Samples on the surface: triangles without area are left out, and the rest still has no border.
TEST(IsoSurface, ThereIsNoBorderWhereSamplesLieOnTheSurface) {
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const auto volume = test::volumeOf({4, 4, 4}, [&](const Vec3&) { return random.below(3) - 1.0; });
    const IsoSurface surface(volume, test::cubicFrame(1e-3),
                             {0, random.below(2) == 0 ? SolidSide::kAbove : SolidSide::kBelow});
    SideUses all;
    for (std::uint32_t c = 0; c < 27; ++c) add(all, sidesOf(surface, surface.cells().at({c % 3, c / 3 % 3, c / 9})));
    for (const auto& [side, use] : sidesOf(surface, surface.cells().at({1, 1, 1})))
      ASSERT_EQ(all[side].balance, 0) << "block " << i;
  }
}

// Linear interpolation has a plane of any tilt exactly.
TEST(IsoSurface, APlaneOfAnyTiltIsFlat) {
  Random random(3);
  for (int i = 0; i < 30; ++i) {
    const Vec3 normal = random.direction(), axis = random.direction();
    const double through = normal.dot(Vec3(20, 20, 20) + random.inCube(3));
    // Samples that floats hold exactly.
    const Vec3 slope = (normal * 1024).array().round() / 1024;
    const auto volume =
        test::volumeOf({41, 41, 41}, [&](const Vec3& at) { return slope.dot(at) - std::round(through * 1024) / 1024; });
    const GridFrame frame =
        test::cubicFrame(2.5e-3).placed(Eigen::AngleAxisd(i, axis).toRotationMatrix(), Vec3::Zero());
    const IsoSurface surface(volume, frame, {0, SolidSide::kAbove});
    const test::Mesh mesh = test::meshOf(surface);
    ASSERT_GT(mesh.triangles.size(), 1000U);
    const Vec3 across = (frame.axes.inverse().transpose() * slope).normalized();
    double low = INFINITY, high = -INFINITY;
    for (const Vec3& vertex : mesh.positions) {
      low = std::min(low, across.dot(vertex));
      high = std::max(high, across.dot(vertex));
    }
    // Where the surface is put through a sample it is off by 2^-30 of a cell at most.
    EXPECT_LT(high - low, 2 * 2.5e-3 * 0x1p-30) << i;
  }
}

// R = 20 mm, sampled as a distance: within h^2 / (2 R), the surface too small and never too large.
TEST(IsoSurface, ASphereIsWithinTheSquareOfItsSpacing) {
  Random random(4);
  for (const double h : {1e-3, 0.5e-3, 0.25e-3}) {
    const double radius = 0.02;
    const auto side = static_cast<std::uint32_t>(std::lround(0.044 / h)) + 1;
    const Vec3 centre = Vec3::Constant(0.022) + random.inCube(h);
    const auto volume =
        test::volumeOf({side, side, side}, [&](const Vec3& at) { return 1e3 * ((h * at - centre).norm() - radius); });
    const IsoSurface surface(volume, test::cubicFrame(h), {0, SolidSide::kBelow});
    const test::Mesh mesh = test::meshOf(surface);
    double least = INFINITY, most = 0, worst_rad = 0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
      const auto& [a, b, c] = mesh.triangles[n];
      for (const Vec3& at : {mesh.positions[a], Vec3((mesh.positions[a] + mesh.positions[b]) / 2),
                             Vec3((mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3)}) {
        least = std::min(least, (at - centre).norm());
        most = std::max(most, (at - centre).norm());
      }
    }
    const DrawnMesh drawn = surface.drawn(~std::size_t{0});
    for (std::size_t i = 0; i < drawn.positions.size(); ++i)
      worst_rad = std::max(worst_rad,
                           std::acos(std::min(1.0, drawn.normals[i].dot((drawn.positions[i] - centre).normalized()))));
    RecordProperty("off_um_at_h_" + std::to_string(h * 1e3), std::to_string(1e6 * (radius - least)));
    EXPECT_GT(least, radius - h * h / (2 * radius) - 1e-9) << h;
    EXPECT_LT(most, radius + 1e-8) << h;
    EXPECT_LT(worst_rad, h / radius) << h;
  }
}

// The bounds and the number of triangles, which are found in a few bricks, against all bricks. Values anywhere between
// the least and the greatest, and beyond.
TEST(IsoSurface, ItsBoundsAreThoseOfAllBricksThatHoldIt) {
  Random random(12);
  int surfaces = 0, without = 0;
  for (int i = 0; i < 3000 * test::longer(); ++i) {
    const auto drawn = test::randomSurface(random);
    const BrickPyramid& pyramid = drawn->volume()->pyramid;
    const double value = random.uniform(-0.1, 1.1) * (pyramid.range().high - pyramid.range().low) + pyramid.range().low;
    const IsoSurface surface(drawn->volume(), drawn->frame(), {value});
    Box box;
    std::uint64_t bricks = 0;
    pyramid.forEachHolding(value, [&](const auto& first, const auto& end) {
      ++bricks;
      for (unsigned c = 0; c < 8; ++c) {
        const auto at = [&](std::size_t axis) { return (c >> axis & 1U) != 0 ? end[axis] : first[axis]; };
        box.extend(surface.frame().point(at(0), at(1), at(2)));
      }
    });
    ASSERT_EQ(surface.bounds().min, box.min) << i;
    ASSERT_EQ(surface.bounds().max, box.max) << i;
    ASSERT_EQ(surface.triangles() == 0, bricks == 0) << i;
    ++(bricks == 0 ? without : surfaces);
  }
  EXPECT_GT(std::min(surfaces, without), 100);
}

// One value of three kinds of samples: each part of their range is one kind.
TEST(IsoSurface, ItsTrianglesAreCountedByTheRangesOfBricks) {
  const auto volume = test::volumeOf({401, 9, 9}, [](const Vec3& at) {
    return at.x() < 100 ? 0 : at.x() < 301 ? 1 : 2;
  });
  EXPECT_EQ(IsoSurface(volume, test::cubicFrame(1), {0.5}).triangles(), 4U * 32);
  EXPECT_EQ(IsoSurface(volume, test::cubicFrame(1), {1.5}).triangles(), 4U * 32);
  EXPECT_EQ(IsoSurface(volume, test::cubicFrame(1), {2.5}).triangles(), 0U);
}

TEST(IsoSurface, ItsTrianglesFaceOutward) {
  for (const bool mirrored : {false, true}) {
    for (const SolidSide solid : {SolidSide::kAbove, SolidSide::kBelow}) {
      const auto volume =
          test::volumeOf({12, 12, 12}, [&](const Vec3& at) { return (at - Vec3::Constant(5.4)).norm(); });
      GridFrame frame = test::cubicFrame(1e-3);
      if (mirrored) frame.axes.col(2) *= -1;
      const IsoSurface surface(volume, frame, {4, solid});
      const Vec3 centre = frame.axes * Vec3::Constant(5.4);
      const double out = solid == SolidSide::kBelow ? 1 : -1;
      const test::Mesh mesh = test::meshOf(surface);
      const DrawnMesh drawn = surface.drawn(~std::size_t{0});
      for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 normal = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
        ASSERT_GT(out * normal.dot(mesh.positions[a] - centre), 0);
      }
      for (std::size_t i = 0; i < drawn.positions.size(); ++i)
        ASSERT_GT(out * drawn.normals[i].dot((drawn.positions[i] - centre).normalized()), 0.9);
    }
  }
}

TEST(IsoSurface, ItsBoundsHoldItAndAreNearIt) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const auto surface = test::randomSurface(random);
    const Box bounds = surface->bounds();
    for (const Vec3& vertex : test::meshOf(*surface).positions) ASSERT_TRUE(bounds.contains({vertex, vertex})) << i;
  }
}

TEST(IsoSurface, ACoarserDrawingHasFewerTrianglesNearTheSurface) {
  const auto volume = test::volumeOf({81, 81, 81}, [&](const Vec3& at) { return (at - Vec3::Constant(40)).norm(); });
  const IsoSurface surface(volume, test::cubicFrame(1e-3), {30, SolidSide::kBelow});
  EXPECT_GT(surface.drawn(1'000'000).triangles.size(), 20'000U);
  const DrawnMesh coarse = surface.drawn(5000);
  EXPECT_LE(coarse.triangles.size(), 5000U);
  EXPECT_GT(coarse.triangles.size(), 500U);
  for (const Vec3& vertex : coarse.positions) EXPECT_NEAR((vertex - Vec3::Constant(0.04)).norm(), 0.03, 1e-3);
}

TEST(IsoSurface, WhatCannotBeIsRefused) {
  const auto volume = test::volumeOf({4, 4, 4}, [](const Vec3& at) { return at.x(); });
  EXPECT_THROW(IsoSurface(volume, test::cubicFrame(1), {NAN, SolidSide::kAbove}), Error);
  EXPECT_THROW(IsoSurface(volume, test::cubicFrame(0), {1, SolidSide::kAbove}), Error);
  EXPECT_THROW(IsoSurface(volume, test::cubicFrame(1e9), {1, SolidSide::kAbove}), Error);
  GridFrame flat = test::cubicFrame(1);
  flat.axes.col(2) = flat.axes.col(0) + 1e-6 * flat.axes.col(2);
  EXPECT_THROW(IsoSurface(volume, flat, {1, SolidSide::kAbove}), Error);
  EXPECT_TRUE(IsoSurface(volume, test::cubicFrame(1), {100, SolidSide::kAbove}).bounds().empty());
}

// A value at the end of the range lies between two neighbours only where it is the greatest, or the least, of several.
TEST(IsoSurface, AValueWithoutATriangleIsRefused) {
  const auto refusal = [](const std::shared_ptr<const Volume>& volume, double iso, SolidSide solid) {
    try {
      requireSurface(IsoSurface(volume, test::cubicFrame(1), {iso, solid}));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto above = SolidSide::kAbove, below = SolidSide::kBelow;
  const auto steps = test::volumeOf({9, 9, 9}, [](const Vec3& at) { return at.x() < 3 ? 0 : at.x() < 6 ? 1 : 2; });
  const std::string range = ": its values are from 0 to 2",
                    none = range + ", and no two neighbours have it between them",
                    all = range + ", as all is matter then";
  for (const double iso : {0.001, 1.0, 1.999}) {
    EXPECT_EQ(refusal(steps, iso, above), "");
    EXPECT_EQ(refusal(steps, iso, below), "");
  }
  EXPECT_EQ(refusal(steps, 0, above), "there is no surface at iso 0" + all);
  EXPECT_EQ(refusal(steps, 0, below), "");
  EXPECT_EQ(refusal(steps, 2, above), "");
  EXPECT_EQ(refusal(steps, 2, below), "there is no surface at iso 2" + all);
  EXPECT_EQ(refusal(steps, -1, below), "there is no surface at iso -1" + range);
  const auto peak = test::volumeOf({9, 9, 9}, [](const Vec3& at) { return at == Vec3(4, 4, 4) ? 2 : 0; });
  EXPECT_EQ(refusal(peak, 2, above), "there is no surface at iso 2" + none) << "a point is no surface";
  EXPECT_EQ(refusal(peak, 1.9, above), "");
  const auto parted = test::volumeOf({9, 2, 2}, [](const Vec3& at) { return at.x() == 4 ? NAN : at.x() < 4 ? 0 : 2; });
  EXPECT_EQ(refusal(parted, 1, above), "there is no surface at iso 1" + none) << "a gap lies between the values";
  const auto one_value = test::volumeOf({4, 4, 4}, [](const Vec3&) { return 2; });
  EXPECT_NE(refusal(one_value, 2, above), "");
  const auto missing = test::volumeOf({4, 4, 4}, [](const Vec3&) { return NAN; });
  EXPECT_EQ(refusal(missing, 2, above), "no voxel of it has a finite value");
}

TEST(IsoSurface, ValuesBeyondSinglePrecisionAreRefused) {
  const auto samples = std::make_shared<std::vector<std::int16_t>>(8, std::int16_t{10});
  const auto refusal = [&](const ValueScale& values) {
    const std::shared_ptr<const void> data(samples, samples->data());
    try {
      Volume volume(VoxelGrid({2, 2, 2}, Samples(SampleKind::kInt16, data), values));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal({1e37, 0}), "");
  EXPECT_NE(refusal({1e38, 0}).find("of 1e+38 and offset of 0 take values beyond"), std::string::npos);
  EXPECT_NE(refusal({-1e300, 0}).find("of -1e+300 and"), std::string::npos);
  EXPECT_NE(refusal({1, 1e39}).find("of 1 and offset of 1e+39 take"), std::string::npos);
}

// What values feel like.

TEST(MatterTable, IsLinearBetweenItsRowsAndConstantBeyondThem) {
  const MatterTable table({{.value = -10, .stiffness = 0.2, .strength_N = 1, .force = {0.5, 2}},
                           {.value = 10, .stiffness = 0.6, .strength_N = 3, .force = {0.1, 6}},
                           {.value = 20, .stiffness = 1, .strength_N = 0, .force = {0, 0}}});
  EXPECT_DOUBLE_EQ(*table.at(0).stiffness, 0.4);
  EXPECT_DOUBLE_EQ(*table.at(5).strength_N, 2.5);
  EXPECT_DOUBLE_EQ(table.at(5).force.resistance_N, 0.2);
  EXPECT_DOUBLE_EQ(table.at(-5).force.drag_Ns_m, 3);
  EXPECT_EQ(*table.at(-1e300).strength_N, 1);
  EXPECT_EQ(*table.at(1e300).stiffness, 1);
  EXPECT_EQ(*table.at(14.9).strength_N, 3) << "0 is never: it is not between";
  EXPECT_EQ(*table.at(15.1).strength_N, 0);
  EXPECT_FALSE(table.at(NAN).stiffness);
  EXPECT_TRUE(table.resists());
  EXPECT_FALSE(MatterTable().resists());
  EXPECT_FALSE(MatterTable().at(3).force.acts());
}

TEST(MatterTable, RefusesWhatMakesNoSense) {
  const auto refused = [](std::vector<MatterRow> rows) { EXPECT_THROW(MatterTable{std::move(rows)}, Error); };
  refused({{.value = 1}, {.value = 1}});
  refused({{.value = 2}, {.value = 1}});
  refused({{.value = NAN}});
  refused({{.value = 1, .stiffness = 1.1}});
  refused({{.value = 1, .stiffness = NAN}});
  refused({{.value = 1, .strength_N = -1}});
  refused({{.value = 1, .force = {-1, 0}}});
  refused({{.value = 1, .force = {0, INFINITY}}});
  refused({{.value = 1, .stiffness = 1}, {.value = 2}});
  refused(std::vector<MatterRow>(MatterTable::kMaxRows + 1));
}

}  // namespace
}  // namespace hl::test_iso_surface
