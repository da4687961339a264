// Solids that are not convex, as hulls that nearly are them.
#include "bodies/nearly_convex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "bodies/mass.h"
#include "draws.h"
#include "environment.h"
#include "mesh_drawings.h"
#include "mesh_judge.h"

namespace hl::test_nearly_convex {
namespace {

using namespace test;

PieceMesh meshOf(const Model& model) {
  std::vector<std::uint32_t> all(model.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return pieceMesh(model, all);
}

// Of a polygon in the plane of x and y, counterclockwise, whose triangulation is given; as thick as 2.
Model prism(const std::vector<Vec3>& outline, const std::vector<Corners>& inside) {
  Model solid;
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const Vec3& at : outline) solid.positions.emplace_back(at + Vec3::UnitZ());
  for (const Vec3& at : outline) solid.positions.emplace_back(at - Vec3::UnitZ());
  for (const auto& [a, b, c] : inside) {
    solid.triangles.push_back({a, b, c});
    solid.triangles.push_back({a + count, c + count, b + count});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t j = (i + 1) % count;
    solid.triangles.push_back({i + count, j + count, j});
    solid.triangles.push_back({i + count, j, i});
  }
  return solid;
}

Model anL() {
  return prism({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
               {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
}

Model aU() {
  return prism({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
               {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}});
}

// A ball with dents and bumps of 1 + `rough` at most.
Model lump(Draws& draws, double rough, int around) {
  const Vec3 waves = draws.between(2, 6) * draws.direction(), phase = draws.between(2, 6) * draws.direction();
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= around / 2; ++i) {
    const double angle = EIGEN_PI * (i - around / 4.0) / (around / 2.0);
    const bool pole = i == 0 || 2 * i == around;
    outline.emplace_back(pole ? 0 : std::cos(angle), pole ? (i == 0 ? -1 : 1) : std::sin(angle));
  }
  Model model = turnedModel(outline, around);
  for (Vec3& vertex : model.positions) vertex *= 1 + rough * std::sin(waves.dot(vertex)) * std::cos(phase.dot(vertex));
  return model;
}

double volumeOf(const NearlyConvex& parts) {
  double volume = 0;
  for (const Hull& hull : parts.hulls) volume += solidOf(hull.shape).volume_m3;
  return volume;
}

double volumeOf(const PieceMesh& mesh) { return solidOf(mesh.vertices, mesh.triangles).volume_m3; }

// How far a point is above all parts.
double above(const NearlyConvex& parts, const Vec3& point) {
  double least = 1e300;
  for (const Hull& hull : parts.hulls) least = std::min(least, heightAbove(hull.shape, point));
  return least;
}

// Places in the bounds and up to a tenth beyond.
Vec3 placeAround(const PieceMesh& mesh, Draws& draws) {
  Box box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  const Vec3 unit(draws.between(-0.1, 1.1), draws.between(-0.1, 1.1), draws.between(-0.1, 1.1));
  return box.min + unit.cwiseProduct(box.size());
}

bool isInside(const PieceMesh& mesh, const Vec3& point) {
  return test::windingAt(mesh.vertices, mesh.triangles, point) > 0.5;
}
double distanceTo(const PieceMesh& mesh, const Vec3& point) {
  return test::distanceToMesh(mesh.vertices, mesh.triangles, point);
}

TEST(NearlyConvex, WhatIsConvexIsItsHull) {
  const NearlyConvex parts = nearlyConvex(meshOf(boxModel(Vec3(1, 2, 3))), 1e-6, 64);
  ASSERT_EQ(parts.hulls.size(), 1u);
  EXPECT_EQ(parts.hulls[0].shape.vertices.size(), 8u);
  EXPECT_LT(parts.error_m(), 1e-12);
}

TEST(NearlyConvex, WhatIsOfBoxesBecomesThem) {
  for (const auto& [solid, boxes] : {std::pair{anL(), 2u}, std::pair{aU(), 3u}}) {
    const NearlyConvex parts = nearlyConvex(meshOf(solid), 1e-3, 64);
    EXPECT_EQ(parts.hulls.size(), boxes);
    EXPECT_NEAR(volumeOf(parts), volumeOf(meshOf(solid)), 1e-9);
    EXPECT_LT(parts.error_m(), 1e-9);
  }
}

TEST(NearlyConvex, DoesNotDependOnTheOrderOfTrianglesNorTheirWinding) {
  const Model given = torusModel(3, 1, 24, 12);
  Model other = given;
  std::reverse(other.triangles.begin(), other.triangles.end());
  for (auto& corners : other.triangles) corners = {corners[1], corners[0], corners[2]};
  const PieceMesh once = meshOf(given), again = meshOf(other);
  EXPECT_EQ(once.vertices, again.vertices);
  EXPECT_EQ(once.triangles, again.triangles);
}

TEST(NearlyConvex, TheHoleOfARingIsOpen) {
  const PieceMesh ring = meshOf(torusModel(3, 1, 48, 24));
  const double size = sizeOf(ring);
  const NearlyConvex parts = nearlyConvex(ring, 0.02 * size, 64);
  EXPECT_LE(parts.error_m(), 0.021 * size);
  EXPECT_LE(parts.hulls.size(), 24u);
  EXPECT_GT(above(parts, Vec3::Zero()), 2 - 0.021 * size) << "nothing is in the hole";
  for (double angle = 0; angle < 6.28; angle += 0.1)
    EXPECT_LT(above(parts, 3 * Vec3(std::cos(angle), 0, std::sin(angle))), 1e-9) << "the middle of the tube is inside";
}

// A thin one too, however it is drawn.
TEST(NearlyConvex, AThinRingIsOpen) {
  for (const auto& [around, across] : {std::pair{48, 10}, {200, 6}, {96, 10}, {32, 8}}) {
    const PieceMesh ring = meshOf(torusModel(0.05, 0.002, around, across));
    const double allowed = 0.02 * sizeOf(ring);
    const NearlyConvex parts = nearlyConvex(ring, allowed, 64);
    EXPECT_LE(parts.error_m(), 1.05 * allowed) << around;
    EXPECT_LE(parts.hulls.size(), 32u) << around;
    for (double angle = 0; angle < 6.28; angle += 0.02) {
      const Vec3 way(std::cos(angle), 0, std::sin(angle));
      EXPECT_GT(above(parts, (0.048 - 1.2 * allowed) * way), 0) << around;
    }
  }
}

// Against the mesh itself, by solid angles: what is outside by more than the error is in no part, nor is anything that
// lies in the mesh near its surface outside of all.
TEST(NearlyConvex, OfRandomLumpsIsAsNearAsItSays) {
  Draws draws(3);
  const int cases = numberIn("HL_LUMPS", 2);
  for (int i = 0; i < cases; ++i) {
    const PieceMesh mesh = meshOf(lump(draws, draws.between(0.05, 0.4), 24));
    const NearlyConvex parts = nearlyConvex(mesh, 0.02 * sizeOf(mesh), 64);
    EXPECT_GT(parts.hulls.size(), 1u);
    EXPECT_LT(parts.error_m(), 0.06 * sizeOf(mesh));
    for (int j = 0; j < 400; ++j) {
      const Vec3 point = placeAround(mesh, draws);
      const bool inside = isInside(mesh, point);
      // The mesh is measured at its corners and middles alone: between them the error may be a little more.
      const double error = parts.error_m() + 0.02 * sizeOf(mesh);
      if (!inside && above(parts, point) < 0) {
        EXPECT_LT(distanceTo(mesh, point), error) << i << ' ' << j;
      }
      if (inside && distanceTo(mesh, point) < 0.01) {
        EXPECT_LT(above(parts, point), error) << i << ' ' << j;
      }
    }
  }
}

TEST(NearlyConvex, OfManyTrianglesCoversThemAll) {
  Draws draws(5);
  const PieceMesh mesh = meshOf(lump(draws, 0.08, 120));
  ASSERT_GT(mesh.triangles.size(), 12'000u);
  const NearlyConvex parts = nearlyConvex(mesh, 0.02 * sizeOf(mesh), 64);
  EXPECT_GT(parts.hulls.size(), 1u);
  EXPECT_LT(parts.error_m(), 0.06 * sizeOf(mesh))
      << parts.excess_m << " " << parts.outside_m << " " << parts.hulls.size();
}

// A bowl without thickness, and one whose walls are thin: parts cover it, and do not fill it.
TEST(NearlyConvex, ABowlIsHollow) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= 8; ++i) outline.emplace_back(std::sin(i * EIGEN_PI / 16), 1 - std::cos(i * EIGEN_PI / 16));
  outline[0].x() = 0;
  Model open = turnedModel(outline, 24);
  std::erase_if(open.triangles, [&](const Corners& corners) {  // those that close the outline from the rim to the axis
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t i) { return i % outline.size() == 0; }) &&
           std::any_of(corners.begin(), corners.end(),
                       [&](std::uint32_t i) { return i % outline.size() + 1 == outline.size(); });
  });
  for (const Model& bowl : {open, beakerModel(1, 2, 0.1, 24)}) {
    const PieceMesh mesh = meshOf(bowl);
    const NearlyConvex parts = nearlyConvex(mesh, 0.02 * sizeOf(mesh), 64);
    EXPECT_GT(above(parts, Vec3(0, 0.5, 0)), 0.2) << parts.hulls.size();
    EXPECT_LT(parts.outside_m, 0.01 * sizeOf(mesh)) << parts.hulls.size();
  }
}

TEST(NearlyConvex, MakesNoMoreThanAreAskedFor) {
  const PieceMesh ring = meshOf(torusModel(3, 1, 24, 12));
  for (const std::size_t most : {1u, 4u, 12u, 64u}) EXPECT_LE(nearlyConvex(ring, 0.001, most).hulls.size(), most);
}

// Triangles that cross each other, in no order, with slivers and doubles: no promise but that it ends and is finite.
TEST(NearlyConvex, TakesAnySoup) {
  Draws draws(11);
  const int cases = numberIn("HL_SOUPS", 2);
  for (int i = 0; i < cases; ++i) {
    Model soup;
    const int vertices = 4 + static_cast<int>(draws.between(0, 30)), grid = 1 + static_cast<int>(draws.between(0, 20));
    for (int j = 0; j < vertices; ++j) {
      const Vec3 at(draws.between(-1, 1), draws.between(-1, 1), draws.between(-1, 1));
      soup.positions.emplace_back(i % 2 == 0 ? at : Vec3((at * grid).array().round() / grid));
    }
    const auto any = [&] { return static_cast<std::uint32_t>(draws.between(0, vertices - 1e-9)); };
    for (int j = 0; j < 2 * vertices; ++j) soup.triangles.push_back({any(), any(), any()});
    const PieceMesh mesh = meshOf(soup);
    try {
      const NearlyConvex parts = nearlyConvex(mesh, 0.02 * sizeOf(mesh), 64);
      EXPECT_GE(parts.hulls.size(), 1u);
      EXPECT_LE(parts.hulls.size(), 64u);
      EXPECT_TRUE(std::isfinite(parts.error_m()));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("hull:"), std::string::npos) << error.what();
    }
  }
}

TEST(NearlyConvex, ASheetIsAPlate) {
  Model sheet;
  sheet.positions = {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}};
  sheet.triangles = {{0, 1, 2}};
  const NearlyConvex plate = nearlyConvex(meshOf(sheet), 0.1, 64);
  ASSERT_EQ(plate.hulls.size(), 1u);
  EXPECT_NEAR(volumeOf(plate), 0.5 * 0.05, 1e-9);
  EXPECT_LT(heightAbove(plate.hulls[0].shape, Vec3(5.7, 0.3, -0.04)), 0) << "it grows inward";
}

}  // namespace
}  // namespace hl::test_nearly_convex
