// Which solids a mesh consists of, and the body that they make.
#include "bodies/mesh_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "bodies/convex_hull.h"
#include "bodies/mesh_body.h"
#include "bodies/mesh_pieces.h"
#include "bodies/piece_mesh.h"
#include "draws.h"
#include "mesh_drawings.h"

namespace hl::test_mesh_parts {
namespace {

using namespace test;

std::size_t countOf(const Model& model) { return piecesOf(model.positions, model.triangles).size(); }

// Each triangle with vertices of its own, as in an STL file.
Model unwelded(const Model& model) {
  Model out;
  for (const auto& corners : model.triangles) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (const std::uint32_t corner : corners) out.positions.push_back(model.positions[corner]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

Model turnedRound(Model model) {
  for (auto& corners : model.triangles) std::swap(corners[0], corners[1]);
  return model;
}

Model movedBy(Model model, const Vec3& way) {
  for (Vec3& vertex : model.positions) vertex += way;
  return model;
}

const Vec3 kOne = Vec3::Constant(1);

TEST(MeshPieces, AreSolidsThatAreApart) {
  EXPECT_EQ(countOf(boxModel(kOne)), 1u);
  EXPECT_EQ(countOf(boxesModel({{kOne, Vec3::Zero()}, {kOne, Vec3(3, 0, 0)}})), 2u);
  EXPECT_EQ(countOf(boxesModel({{kOne, Vec3::Zero()}, {kOne, Vec3(1, 0.5, 0.5)}})), 2u) << "they overlap";
  EXPECT_EQ(piecesOf({}, {}).size(), 0u);
}

TEST(MeshPieces, OfNeighboursThatShareCornersAreDistinguished) {
  for (const Vec3& at : {Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(2, 2, 2), Vec3(0, -2, 0), Vec3(0, 2, -2)}) {
    const Model two = boxesModel({{kOne, Vec3::Zero()}, {kOne, at}});
    for (const Model& model : {two, unwelded(two), turnedRound(two), movedBy(two, Vec3(1e3, -1e3, 500))}) {
      const auto pieces = piecesOf(model.positions, model.triangles);
      ASSERT_EQ(pieces.size(), 2u) << at.transpose();
      for (std::uint32_t i = 0; i < 12; ++i) EXPECT_EQ(pieces[0][i], i);
    }
  }
  for (const int wedges : {3, 8, 32}) {
    const Model ring = ringModel(0.5, 1, 0.2, wedges);
    EXPECT_EQ(countOf(ring), static_cast<std::size_t>(wedges));
    EXPECT_EQ(countOf(turnedRound(unwelded(ring))), static_cast<std::size_t>(wedges));
  }
}

// A box of 27 boxes: each inner edge has four of them.
TEST(MeshPieces, OfABlockOfBlocksAreTheBlocks) {
  std::vector<std::pair<Vec3, Vec3>> blocks;
  for (int i = 0; i < 27; ++i) blocks.emplace_back(kOne, 2 * Vec3(i % 3, i / 3 % 3, i / 9));
  EXPECT_EQ(countOf(boxesModel(blocks)), 27u);
}

TEST(MeshPieces, AreTheSameAtAnyScaleAndInAnyOrder) {
  Draws draws(7);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Model ring = ringModel(0.5 * scale, scale, 0.2 * scale, 12);
    std::shuffle(ring.triangles.begin(), ring.triangles.end(), draws.random);
    EXPECT_EQ(countOf(ring), 12u);
  }
}

// Walls whose corners are one in another, with edges in common: distinguished by the order of their triangles.
TEST(MeshPieces, OfACupAreItsWallsAndBottom) {
  EXPECT_EQ(countOf(cupModel(1, 2, 0.1)), 5u);
  EXPECT_EQ(countOf(unwelded(cupModel(1, 2, 0.1))), 5u);
}

TEST(MeshPieces, LeaveOutWhatHasNoArea) {
  Model model = boxModel(kOne);
  model.triangles.push_back({0, 0, 1});
  model.triangles.push_back({2, 2, 2});
  const auto pieces = piecesOf(model.positions, model.triangles);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].size(), 12u);
}

// An open sheet, two sheets, and triangles that wind as they like: no more can be said than that they meet.
TEST(MeshPieces, OfSheetsAreTheSheets) {
  Model sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {2, 0, 3}};
  EXPECT_EQ(countOf(sheet), 1u);
  Model two = sheet;
  addMesh(two, sheet, Vec3(0, 0, 1));
  EXPECT_EQ(countOf(two), 2u);
}

BodySpec partsSpec() {
  BodySpec spec;
  spec.shape = BodyShape::kParts;
  return spec;
}

std::string errorOf(const Model& model) {
  try {
    bodyOf(model, partsSpec());
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

// Two posts of a x h x a, joined by a bar of b x a x a between them: by the parallel axis theorem.
// A prism over a bow tie, whose one half faces inward: the signed integrals of what it holds have no inertia that any
// matter could have, and a body of it would gain energy from nothing.
TEST(MeshParts, OfAMeshThatCrossesItselfHaveAnInertiaThatMatterCanHave) {
  for (const double part : {0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0}) {
    const double one = 0.02, other = one * part;
    Model bow;
    for (const double z : {-0.01, 0.01}) {
      for (const Vec3& corner :
           {Vec3(-one, -one, z), Vec3(other, other, z), Vec3(other, -other, z), Vec3(-one, one, z)})
        bow.positions.push_back(corner);
    }
    bow.triangles = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6},
                     {3, 0, 4}, {3, 4, 7}, {0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
    const Body body = bodyOf(bow, partsSpec());
    const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(body.mass.inertia_kg_m2).eigenvalues();
    EXPECT_GT(moments[0], 0) << part;
    EXPECT_LE(moments[2], (moments[0] + moments[1]) * (1 + 1e-12)) << part;
    EXPECT_TRUE((body.mass.centre_O.cwiseAbs().array() < 0.02).all()) << part;
  }
}

TEST(MeshParts, AnHHasTheInertiaOfItsThreeBoxes) {
  constexpr double kPost = 0.01, kHigh = 0.06, kBar = 0.04;
  const Vec3 post(kPost / 2, kHigh / 2, kPost / 2), bar(kBar / 2, kPost / 2, kPost / 2), off(0.3, -0.1, 0.2);
  const double arm = (kBar + kPost) / 2;
  const Model model = boxesModel({{post, off - arm * Vec3::UnitX()}, {bar, off}, {post, off + arm * Vec3::UnitX()}});
  const Body body = bodyOf(model, partsSpec());
  const double m_post = 1000 * 8 * post.prod(), m_bar = 1000 * 8 * bar.prod();
  EXPECT_EQ(body.shape.parts.size(), 3u);
  EXPECT_NEAR(body.mass.mass_kg, 2 * m_post + m_bar, 1e-12);
  EXPECT_LT((body.mass.centre_O - off).norm(), 1e-12);
  const Mat3 boxes = 2 * massOfBox(m_post, post).inertia_kg_m2 + massOfBox(m_bar, bar).inertia_kg_m2;
  const double steiner = 2 * m_post * arm * arm;
  const Mat3 expected = boxes + Vec3(0, steiner, steiner).asDiagonal().toDenseMatrix();
  EXPECT_LT((body.mass.inertia_kg_m2 - expected).norm(), 1e-12 * expected.norm());
  EXPECT_NEAR(body.shape.reach, Vec3(arm + kPost / 2, kHigh / 2, kPost / 2).norm(), 1e-12);
}

TEST(MeshParts, AreInTheFrameOfTheBodyEachWithItsMiddle) {
  const Body body = bodyOf(movedBy(ringModel(0.02, 0.03, 0.005, 16), Vec3(1, 2, 3)), partsSpec());
  ASSERT_EQ(body.shape.parts.size(), 16u);
  EXPECT_LT(body.hull_error_m, 1e-15);
  for (const Convex& part : body.shape.parts) {
    EXPECT_NEAR(part.middle.norm(), 0.025, 3e-4);
    EXPECT_LT(heightAbove(part, part.middle), -0.002);
    EXPECT_GT(heightAbove(part, Vec3::Zero()), 0.019) << "the hole is open";
    for (const Vec3& vertex : part.vertices) EXPECT_LE((vertex - part.middle).norm(), part.reach);
  }
}

// Of one piece it is its hull.
TEST(MeshParts, OfOnePieceAreItsHull) {
  BodySpec as_hull;
  const Model model = movedBy(boxModel(Vec3(0.01, 0.02, 0.03)), Vec3(0.1, 0, 0));
  const Body hull = bodyOf(model, as_hull), parts = bodyOf(model, partsSpec());
  ASSERT_EQ(parts.shape.parts.size(), 1u);
  EXPECT_NEAR(parts.shape.reach, hull.shape.reach, 1e-15);
  EXPECT_NEAR(parts.mass.mass_kg, hull.mass.mass_kg, 1e-15);
  EXPECT_LT((parts.mass.inertia_kg_m2 - hull.mass.inertia_kg_m2).norm(), 1e-12 * hull.mass.inertia_kg_m2.norm());
}

// A mesh that is there twice, and the inner side of a hollow ball.
TEST(MeshParts, WithinOthersDoNotCount) {
  const Body body =
      bodyOf(boxesModel({{kOne / 2, Vec3::Zero()}, {kOne, Vec3::Zero()}, {kOne, Vec3::Zero()}}), partsSpec());
  EXPECT_EQ(body.shape.parts.size(), 1u);
  EXPECT_NEAR(body.mass.mass_kg, 8000, 1e-9);
}

TEST(MeshParts, WhatHasNoneSaysWhatToDo) {
  Model lines;
  lines.positions = boxModel(kOne).positions;
  lines.segments = {{0, 1}, {0, 2}, {0, 4}, {1, 7}};
  EXPECT_EQ(errorOf(lines), "its mesh has no triangles, and so no parts: use its hull or a box");
}

// A box with a hollow, whichever way all of it faces: mass and inertia are those of the one less those of the other.
TEST(MeshParts, AHollowIsTakenOff) {
  Model hollow = turnedRound(boxModel(kOne / 2)), model = boxModel(kOne);
  addMesh(model, hollow, Vec3(0.2, 0, 0));
  const Solid solid = partsOfMesh(model).solid, turned = partsOfMesh(turnedRound(model)).solid;
  EXPECT_NEAR(solid.volume_m3, 7, 1e-12);
  EXPECT_LT((solid.centre_O - Vec3(-0.2 / 7, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(solid.inertia_m5(0, 0), 8.0 * 2 / 3 - 1.0 / 6, 1e-12);
  EXPECT_EQ(turned.volume_m3, solid.volume_m3);
}

// Its hull has 64 vertices: the mass is that of its mesh.
TEST(MeshParts, OfAFineBallHaveTheMassOfItsMesh) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= 20; ++i)
    outline.emplace_back(i % 20 == 0 ? 0 : std::sin(EIGEN_PI * i / 20), -std::cos(EIGEN_PI * i / 20));
  const Model model = turnedModel(outline, 40);
  const MeshParts made = partsOfMesh(model);
  EXPECT_EQ(made.shape.parts.size(), 1u);
  std::vector<std::uint32_t> all(model.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  const PieceMesh mesh = pieceMesh(model, all);
  EXPECT_NEAR(made.solid.volume_m3, solidOf(mesh.vertices, mesh.triangles).volume_m3, 1e-12);
  EXPECT_GT(made.solid.volume_m3, 1.02 * solidOf(made.shape.parts[0]).volume_m3);
}

TEST(MeshParts, ASliverBesideABoxIsLeftOut) {
  for (const double width : {1e-9, 1e-7, 1e-5}) {
    Model model = boxModel(kOne), sliver;
    sliver.positions = {{5, 0, 0}, {6, 0, 0}, {6, width, 0}};
    sliver.triangles = {{0, 1, 2}};
    addMesh(model, sliver);
    EXPECT_EQ(errorOf(model), "") << width;
    EXPECT_NE(errorOf(sliver), "") << width;
  }
}

// Twice the same ring, as it is and turned round, is one; two rings share the parts.
TEST(MeshParts, OfTwoRingsAreSharedAndOfOneThatIsThereTwiceAreThoseOfOne) {
  const Model ring = torusModel(0.05, 0.01, 24, 12);
  const std::size_t once = partsOfMesh(ring).shape.parts.size();
  Model twice = ring, two = ring;
  addMesh(twice, turnedRound(ring));
  addMesh(two, ring, Vec3(0, 0.1, 0));
  const MeshParts of_twice = partsOfMesh(twice), of_two = partsOfMesh(two);
  EXPECT_EQ(of_twice.shape.parts.size(), once);
  EXPECT_NEAR(of_twice.solid.volume_m3, partsOfMesh(ring).solid.volume_m3, 1e-15);
  EXPECT_LT(of_two.excess_m, 0.021 * two.bounds().size().norm() / 2);
}

// A plate without thickness beside a box: it gets one.
TEST(MeshParts, WhatIsFlatGetsAThickness) {
  Model model = boxModel(kOne), sheet;
  sheet.positions = {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}};
  sheet.triangles = {{0, 1, 2}};
  addMesh(model, sheet);
  const Body body = bodyOf(model, partsSpec());
  EXPECT_EQ(body.shape.parts.size(), 2u);
  EXPECT_NEAR(body.mass.mass_kg, 8000, 40);
}

// Boxes on a circle: a hull of neighbours is near enough to them, one of all is not.
TEST(MeshParts, OfMorePiecesThanMayBeAreCutTogether) {
  for (const std::size_t count : {kMaxParts, kMaxParts + 1, std::size_t{120}}) {
    std::vector<std::pair<Vec3, Vec3>> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2 * EIGEN_PI * static_cast<double>(i) / static_cast<double>(count);
      boxes.emplace_back(0.1 * kOne, 10 * Vec3(std::cos(angle), 0, std::sin(angle)));
    }
    const MeshParts made = partsOfMesh(boxesModel(boxes));
    const std::vector<Convex>& parts = made.shape.parts;
    EXPECT_LE(parts.size(), kMaxParts);
    EXPECT_GE(parts.size(), count == kMaxParts ? kMaxParts : std::size_t{8});
    EXPECT_LT(made.error_m, 0.02 * 14.3);
    EXPECT_LT(made.excess_m, 0.4);
    for (double angle = 0; angle < 6.28; angle += 0.02) {
      const Vec3 within = 9 * Vec3(std::cos(angle), 0, std::sin(angle)) - made.solid.centre_O;
      EXPECT_TRUE(
          std::all_of(parts.begin(), parts.end(), [&](const Convex& part) { return heightAbove(part, within) > 0; }));
    }
    EXPECT_NEAR(made.solid.volume_m3, 0.008 * static_cast<double>(count), 1e-9);
  }
}

}  // namespace
}  // namespace hl::test_mesh_parts
