// Meshes that are not closed: what closes them, and the mass of a body of their parts.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bodies/mesh_body.h"
#include "bodies/mesh_holes.h"
#include "bodies/mesh_parts.h"
#include "draws.h"
#include "environment.h"
#include "mesh_drawings.h"
#include "mesh_judge.h"

namespace hl::test_open_meshes {
namespace {

using namespace test;

constexpr double kSide = 0.06;

PieceMesh wholeOf(const Model& model) {
  std::vector<std::uint32_t> all(model.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return pieceMesh(model, all);
}

// The triangles of a box come in pairs, one for each face.
Model boxWithout(const Vec3& half, std::size_t face) {
  Model model = boxModel(half);
  const auto first = model.triangles.begin() + static_cast<std::ptrdiff_t>(2 * face);
  model.triangles.erase(first, first + 2);
  return model;
}

// A curve of the half plane x > 0 turned about the y axis, upward with the air outside.
Model sweptModel(const std::vector<Eigen::Vector2d>& curve, int around) {
  Model model = turnedModel(curve, around);
  const auto count = static_cast<std::uint32_t>(curve.size());
  std::erase_if(model.triangles, [&](const Corners& corners) {  // those from the last point to the first
    const auto has = [&](std::uint32_t number) {
      return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t i) { return i % count == number; });
    };
    return has(0) && has(count - 1);
  });
  return model;
}

Model tubeModel(double radius, double height, int around) {
  return sweptModel({{radius, 0}, {radius, height / 2}, {radius, height}}, around);
}

// A ball up to this angle from below.
Model bowlModel(double radius, double angle, int around) {
  std::vector<Eigen::Vector2d> curve;
  for (int i = 0; i <= 8; ++i)
    curve.emplace_back(i == 0 ? 0 : radius * plain::sin(angle * i / 8), -radius * plain::cos(angle * i / 8));
  return sweptModel(curve, around);
}

Model turnedAnyhow(Model model, Draws& draws) {
  const Mat3 turn = Eigen::AngleAxisd(draws.between(0, 6), draws.direction()).toRotationMatrix();
  const Vec3 way = draws.between(0, 1) * draws.direction();
  for (Vec3& vertex : model.positions) vertex = turn * vertex + way;
  return model;
}

Body bodyOfParts(const Model& model) {
  BodySpec spec;
  spec.shape = BodyShape::kParts;
  return bodyOf(model, spec);
}

Vec3 momentsOf(const Body& body) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(body.mass.inertia_kg_m2, Eigen::EigenvaluesOnly).eigenvalues();
}

double areaOf(const Model& model) {
  double area = 0;
  for (const auto& [a, b, c] : model.triangles) {
    const Vec3 &p = model.positions[a], &q = model.positions[b], &r = model.positions[c];
    area += (q - p).cross(r - p).norm() / 2;
  }
  return area;
}

double distanceTo(const Model& model, const Vec3& point) {
  return test::distanceToMesh(model.positions, model.triangles, point);
}
double windingAt(const Model& model, const Vec3& point) {
  return test::windingAt(model.positions, model.triangles, point);
}

// How far random points of the parts are beyond the mesh, of half the diagonal of its bounds. A shell is its surface.
double beyond(const Model& model, const Body& body, Draws& draws) {
  constexpr int kPoints = 2000;
  double most = 0;
  for (const Convex& part : body.shape.parts) {
    for (int i = 0; i < kPoints / static_cast<int>(body.shape.parts.size()); ++i) {
      Vec3 point = Vec3::Zero();
      double sum = 0;
      for (const Vec3& vertex : part.vertices) {
        const double weight = std::pow(draws.between(0, 1), 8);  // near the corners too
        point += weight * vertex;
        sum += weight;
      }
      point = point / sum + body.mass.centre_O;
      const double distance = distanceTo(model, point);
      if (distance > most && (body.shell_m > 0 || windingAt(model, point) < 0.5)) most = distance;
    }
  }
  return most / (model.bounds().size().norm() / 2);
}

TEST(MeshHoles, OfAClosedMeshAreNone) {
  for (const Model& model : {boxModel(Vec3(1, 2, 3)), torusModel(3, 1, 24, 12), beakerModel(1, 2, 0.1, 24)}) {
    const PieceMesh mesh = wholeOf(model);
    const CappedMesh closed = capped(mesh);
    EXPECT_EQ(closed.open_edges, 0u);
    EXPECT_EQ(closed.caps_m2, 0);
    EXPECT_EQ(closed.vertices, mesh.vertices);
    EXPECT_EQ(closed.triangles, mesh.triangles);
  }
}

TEST(MeshHoles, AreClosedByCaps) {
  const PieceMesh box = wholeOf(boxWithout(Vec3(1, 2, 3), 0)), tube = wholeOf(tubeModel(1, 2, 24));
  const CappedMesh of_box = capped(box), of_tube = capped(tube);
  EXPECT_EQ(of_box.open_edges, 4u);
  EXPECT_NEAR(solidOf(of_box.vertices, of_box.triangles).volume_m3, 48, 1e-12);
  EXPECT_EQ(of_tube.open_edges, 48u);
  const double disc = 12 * std::sin(EIGEN_PI / 12);
  EXPECT_NEAR(of_tube.caps_m2, 2 * disc, 1e-12);
  EXPECT_NEAR(solidOf(of_tube.vertices, of_tube.triangles).volume_m3, 2 * disc, 1e-12);
}

// Of two holes in opposite sides the normals cancel, and they are holes none the less.
TEST(MeshHoles, OfMoreThanASmallPartMakeAShell) {
  EXPECT_TRUE(capped(wholeOf(tubeModel(1, 2, 24))).isShell());
  EXPECT_TRUE(capped(wholeOf(boxWithout(Vec3(1, 1, 1), 3))).isShell());
  EXPECT_TRUE(capped(wholeOf(bowlModel(1, EIGEN_PI / 2, 24))).isShell());
  EXPECT_FALSE(capped(wholeOf(bowlModel(1, 0.95 * EIGEN_PI, 24))).isShell());
  EXPECT_FALSE(capped(wholeOf(boxModel(Vec3(1, 1, 1)))).isShell());
}

// A cylinder whose side has corners between those of its ends: its edges do not fit, but there is no hole.
TEST(MeshHoles, CracksAreNone) {
  constexpr int kAround = 24;
  Model model = tubeModel(1, 2, kAround), ends = tubeModel(1, 2, kAround / 2);
  for (const std::uint32_t ring : {0u, 2u}) {
    for (std::uint32_t i = 0; i < kAround / 2; ++i) {  // the end's edges, and its middle
      const std::uint32_t here = 3 * 2 * i + ring, next = 3 * 2 * ((i + 1) % (kAround / 2)) + ring;
      const auto middle = static_cast<std::uint32_t>(model.positions.size());
      if (i == 0) model.positions.emplace_back(0, ring, 0);
      const std::uint32_t axis = i == 0 ? middle : middle - 1;
      ring == 0 ? model.triangles.push_back({axis, next, here}) : model.triangles.push_back({axis, here, next});
    }
  }
  const CappedMesh closed = capped(wholeOf(model));
  EXPECT_FALSE(closed.isShell());
  EXPECT_NEAR(solidOf(closed.vertices, closed.triangles).volume_m3, 2 * 12 * std::sin(EIGEN_PI / 12), 0.1);
}

// Each triangle with corners that were rounded for it.
TEST(MeshHoles, RoundingMakesNone) {
  Draws draws(3);
  const Model ring = torusModel(3, 1, 24, 12);
  Model rounded;
  for (const Corners& corners : ring.triangles) {
    const auto first = static_cast<std::uint32_t>(rounded.positions.size());
    for (const std::uint32_t corner : corners)
      rounded.positions.emplace_back(ring.positions[corner] + 1e-7 * draws.direction());
    rounded.triangles.push_back({first, first + 1, first + 2});
  }
  const Body body = bodyOfParts(rounded);
  EXPECT_EQ(body.open_edges, 0u);
  EXPECT_NEAR(body.mass.mass_kg, bodyOfParts(ring).mass.mass_kg, 1e-6 * body.mass.mass_kg);
}

// A box without one of its faces is a shell of 1 % of what it reaches, whichever lacks and however it lies.
TEST(OpenMeshes, ABoxHasTheSameMassWhicheverFaceLacks) {
  Draws draws(4);
  const double half = kSide / 2, middle = kSide / 10, reach = Vec3(half + middle, half, half).norm();
  const double expected = 1000 * 5 * kSide * kSide * 0.01 * reach;
  const Vec3 moments = momentsOf(bodyOfParts(boxWithout(Vec3::Constant(half), 0)));
  for (std::size_t face = 0; face < 6; ++face) {
    const Model box = boxWithout(Vec3::Constant(half), face);
    const Body straight = bodyOfParts(box);
    EXPECT_NEAR(straight.mass.centre_O.norm(), middle, 1e-12) << face;
    EXPECT_LE(straight.shape.parts.size(), 6u) << face << ": about one for each face";
    EXPECT_LT(beyond(box, straight, draws), 0.015) << face;
    for (const Model& model : {box, turnedAnyhow(box, draws), turnedAnyhow(box, draws)}) {
      const Body body = bodyOfParts(model);
      EXPECT_NEAR(body.mass.mass_kg, expected, 1e-9 * expected) << face;
      EXPECT_LT((momentsOf(body) - moments).norm(), 1e-9 * moments.norm()) << face;
      EXPECT_EQ(body.open_edges, 4u);
      EXPECT_NEAR(body.shell_m, 0.01 * reach, 1e-12);
    }
  }
}

// The inertia of a thin tube, m (r^2 / 2 + h^2 / 12) about a line across it, and m r^2 about its axis.
TEST(OpenMeshes, ATubeIsAShell) {
  Draws draws(5);
  constexpr double kRadius = 0.03, kHeight = 0.08;
  const Model tube = tubeModel(kRadius, kHeight, 96);
  for (const Model& model : {tube, turnedAnyhow(tube, draws)}) {
    const Body body = bodyOfParts(model);
    const double m = 1000 * 2 * EIGEN_PI * kRadius * kHeight * 0.0005;
    EXPECT_NEAR(body.mass.mass_kg, m, 1e-3 * m);
    const double across = m * (kRadius * kRadius / 2 + kHeight * kHeight / 12), along = m * kRadius * kRadius;
    EXPECT_LT((momentsOf(body) - Vec3(along, across, across)).norm(), 2e-3 * across);
    EXPECT_EQ(body.open_edges, 192u);
    EXPECT_LT(beyond(model, body, draws), 0.025);
  }
}

TEST(OpenMeshes, ABallWithASmallHoleIsABall) {
  const Model open = bowlModel(1, 0.95 * EIGEN_PI, 48);
  const Body body = bodyOfParts(open);
  EXPECT_EQ(body.shell_m, 0);
  EXPECT_EQ(body.open_edges, 48u);
  double inside = 0;  // by points of a grid, each with its winding number
  constexpr int kGrid = 40;
  for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
    const Vec3 point =
        Vec3(i % kGrid, i / kGrid % kGrid, i / kGrid / kGrid) * (2.0 / kGrid) + Vec3::Constant(1.0 / kGrid - 1);
    if (windingAt(open, point) > 0.5) inside += std::pow(2.0 / kGrid, 3);
  }
  EXPECT_NEAR(body.mass.mass_kg, 1000 * inside, 0.01 * body.mass.mass_kg);
}

// Rings and beakers, closed: they weigh what they hold, and their parts reach beyond them as far as they say, at most
// by what is allowed, unless there are as many as may be.
TEST(OpenMeshes, PartsOfClosedOnesReachNoFartherThanTheySay) {
  Draws draws(6);
  const int cases = numberIn("HL_CLOSED_MESHES", 2);
  for (int i = 0; i < cases; ++i) {
    const double thick = draws.between(0.1, 0.4);
    for (const Model& model :
         {torusModel(3, draws.between(0.3, 1.5), 24, 12), beakerModel(1, draws.between(0.5, 3), thick, 24)}) {
      const Body body = bodyOfParts(model);
      const double size = model.bounds().size().norm() / 2;
      const PieceMesh mesh = wholeOf(model);
      const Solid solid = sumOf(std::array{solidOf(mesh.vertices, mesh.triangles)});
      EXPECT_EQ(body.mass.mass_kg, 1000 * solid.volume_m3);
      EXPECT_EQ(body.mass.centre_O, solid.centre_O);
      EXPECT_EQ(body.open_edges, 0u);
      if (body.shape.parts.size() < kMaxParts) {
        EXPECT_LE(body.excess_m, kNearlyConvex * size) << i;
      }
      EXPECT_LT(beyond(model, body, draws), body.excess_m / size + 0.01) << i;
    }
  }
}

// Boxes of any sides without a face, tubes and bowls weigh their area, and as much when they are turned.
TEST(OpenMeshes, OfAnyShapeAreShells) {
  Draws draws(7);
  const int cases = numberIn("HL_OPEN_MESHES", 2);
  for (int i = 0; i < cases; ++i) {
    const Vec3 half(draws.between(0.5, 1), draws.between(0.5, 1), draws.between(0.5, 1));
    for (const Model& model :
         {boxWithout(half, static_cast<std::size_t>(draws.between(0, 5.99))),
          tubeModel(draws.between(0.2, 1), draws.between(0.5, 2), 20), bowlModel(1, draws.between(0.6, 2.4), 16)}) {
      const Body body = bodyOfParts(model), other = bodyOfParts(turnedAnyhow(model, draws));
      EXPECT_NEAR(other.mass.mass_kg, body.mass.mass_kg, 1e-9 * body.mass.mass_kg);
      EXPECT_NEAR(body.mass.mass_kg, 1000 * areaOf(model) * body.shell_m, 1e-9 * body.mass.mass_kg);
      EXPECT_GT(body.shell_m, 0);
    }
  }
}

}  // namespace
}  // namespace hl::test_open_meshes
