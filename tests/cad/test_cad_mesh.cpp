// CAD shapes as triangles: without cracks, within the deflection, with the normals of their surfaces; and touched.
#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <gp_Circ.hxx>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "base/error.h"
#include "cad/cad_mesh.h"
#include "cad_shapes.h"
#include "proxy/proxy.h"
#include "scene/scene_model.h"

namespace hl::test_cad_mesh {
namespace {

Model meshOf(const TopoDS_Shape& shape, const CadMeshing& meshing = {}, std::size_t most = kMaxCadTriangles) {
  return meshCad(
      {shape}, meshing, [](double) {}, most);
}

double volumeOf(const Model& model) {
  double six_times = 0;
  for (const auto& t : model.triangles)
    six_times += model.positions[t[0]].dot(model.positions[t[1]].cross(model.positions[t[2]]));
  return six_times / 6;
}

using Bits = std::array<double, 3>;
Bits bitsOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Sides of triangles that have no other beside them, in the other direction, with the same bits.
std::size_t openSides(const Model& model) {
  std::map<std::pair<Bits, Bits>, int> sides;
  for (const auto& t : model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Bits a = bitsOf(model.positions[t[k]]), b = bitsOf(model.positions[t[(k + 1) % 3]]);
      if (a < b) ++sides[{a, b}];
      if (b < a) --sides[{b, a}];
    }
  }
  std::size_t open = 0;
  for (const auto& [side, balance] : sides) open += balance == 0 ? 0 : 1;
  return open;
}

TEST(CadMesh, IsClosedToTheBitAndWithinItsDeflection) {
  constexpr double kPi = M_PI, kE = 2e-6;
  struct Case {
    const char* name;
    TopoDS_Shape shape;
    double volume_m3, curved_m2;
  };
  const double round = 2.5e-3, flat = 20e-3 - 2 * round;
  for (const Case& c : {
           Case{"bore", test::bored(5, 10), 20e-3 * 20e-3 * 10e-3 - kPi * 25e-6 * 10e-3, 2 * kPi * 5e-3 * 10e-3},
           Case{"sphere", BRepPrimAPI_MakeSphere(5).Shape(), 4 * kPi / 3 * std::pow(5e-3, 3), 4 * kPi * 25e-6},
           Case{"fillets", test::rounded(2.5),
                flat * flat * flat + 6 * flat * flat * round + 3 * kPi * round * round * flat +
                    4 * kPi / 3 * std::pow(round, 3),
                6 * kPi * round * flat + 4 * kPi * round * round},
       }) {
    const Model model = meshOf(c.shape);
    EXPECT_EQ(openSides(model), 0u) << c.name;
    EXPECT_NEAR(volumeOf(model), c.volume_m3, c.curved_m2 * kE) << c.name;
    ASSERT_TRUE(model.reading.cad) << c.name;
    EXPECT_GT(model.reading.cad->error_m, 0.1 * kE) << c.name;
    EXPECT_LE(model.reading.cad->error_m, kE + model.reading.cad->tolerance_m) << c.name;
    EXPECT_EQ(model.reading.cad->solids, 1u) << c.name;
    EXPECT_TRUE(model.warnings.empty()) << c.name;
  }
}

TEST(CadMesh, VerticesLieOnTheSurfaceWithItsNormals) {
  const Model ball = meshOf(BRepPrimAPI_MakeSphere(25).Shape(), {2e-5, 0.1});
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    ASSERT_NEAR(ball.positions[i].norm(), 25e-3, 1e-12);
    ASSERT_LT((ball.normals[i] - ball.positions[i].normalized()).norm(), 1e-7) << ball.positions[i].transpose();
  }
}

// Where a fillet goes over into a plane, both have the same normal; at a sharp edge they have not.
TEST(CadMesh, NormalsAgreeWhereFacesAreTangentAndDifferAtEdges) {
  const auto widest = [](const Model& model) {
    std::map<Bits, Vec3> first;
    double most = 0;
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
      const Vec3& there = first.try_emplace(bitsOf(model.positions[i]), model.normals[i]).first->second;
      most = std::max(most, (there - model.normals[i]).norm());
    }
    return most;
  };
  EXPECT_LT(widest(meshOf(test::rounded(3))), 1e-6);
  EXPECT_NEAR(widest(meshOf(test::boxOf({0, 0, 0}, {1, 2, 3}))), std::sqrt(2.0), 1e-12);
}

TEST(CadMesh, PlacedAndMirroredPartsAreClosedAndFaceOutward) {
  gp_Trsf mirror, move;
  mirror.SetMirror(gp_Ax2(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 2)));
  move.SetRotation(gp_Ax1(gp_Pnt(3, 1, 4), gp_Dir(1, 5, 9)), 0.7);
  const TopoDS_Shape part = test::rounded(2.5);
  for (const TopoDS_Shape& shape :
       {part.Moved(TopLoc_Location(move)), BRepBuilderAPI_Transform(part, mirror).Shape()}) {
    const Model model = meshOf(shape, {2e-5, 0.3});
    EXPECT_EQ(openSides(model), 0u);
    EXPECT_GT(volumeOf(model), 7e-6);
    for (const auto& t : model.triangles) {
      const Vec3 &a = model.positions[t[0]], &b = model.positions[t[1]], &c = model.positions[t[2]];
      ASSERT_GE((b - a).cross(c - a).dot(model.normals[t[0]]), 0);
    }
  }
}

TEST(CadMesh, EdgesWithoutFacesBecomeSegments) {
  const Model ring = meshOf(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(), 10)).Edge(), {1e-4, 0.1});
  EXPECT_TRUE(ring.triangles.empty());
  EXPECT_GE(ring.segments.size(), 62u);
  for (const Vec3& at : ring.positions) EXPECT_NEAR(at.norm(), 10e-3, 1e-12);
}

TEST(CadMesh, TooManyTrianglesAreRefusedWithADeflectionThatFits) {
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(50).Shape();
  std::string line;
  try {
    meshOf(ball, {1e-6, 0.01, true}, 20'000);
  } catch (const Error& error) {
    line = error.what();
  }
  const std::string kWord = "--deflection ";
  ASSERT_NE(line.find(kWord), std::string::npos) << line;
  const double deflection_m = std::stod(line.substr(line.find(kWord) + kWord.size()));
  EXPECT_GT(deflection_m, 1e-6);
  EXPECT_LT(meshOf(ball, {deflection_m, 0.1, true}, 20'000).triangles.size(), 30'000u);
}

// A ball of 10 m would have 50 million triangles: that is seen at once, and where nobody has asked for them there are
// fewer.
TEST(CadMesh, WhatNobodyHasAskedForIsAsFineAsItFits) {
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(1e4).Shape();
  EXPECT_THROW(meshOf(ball, {2e-6, 0.1, true}), Error);
  const Model model = meshOf(BRepPrimAPI_MakeSphere(100).Shape());
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("--deflection chooses another"), std::string::npos);
  EXPECT_GT(model.triangles.size(), 50'000u);
  EXPECT_LT(model.triangles.size(), 400'000u);
  EXPECT_GT(model.reading.cad->deflection_m, CadMeshing{}.deflection_m);
}

// Where the proxy comes to rest as the finger goes from one place to another.
Vec3 restOf(const TopoDS_Shape& shape, double radius, const Vec3& from, const Vec3& to) {
  const auto scene = makeSnapshot(SceneModel(meshOf(shape)));
  ProxySettings settings;
  settings.radius = radius;
  settings.work_cap = kNoWorkCap;
  ProxyState state = startProxy(*scene, settings, from);
  for (int i = 1; i <= 100; ++i) tick(state, *scene, settings, from + 0.01 * i * (to - from));
  for (int i = 0; i < 300; ++i) tick(state, *scene, settings, to);
  return state.position;
}

TEST(CadTouch, ABallInABoreRestsOneRadiusInside) {
  const TopoDS_Shape block = test::bored(5, 10);
  for (int i = 0; i < 12; ++i) {
    const Vec3 out(std::cos(0.5 * i + 0.1), std::sin(0.5 * i + 0.1), 0);
    const Vec3 middle(0, 0, 5e-3), finger = middle + 9e-3 * out;
    const Vec3 centre = restOf(block, 1e-3, middle, finger);
    EXPECT_NEAR((centre - middle).norm(), 4e-3, 3e-6) << i;
    EXPECT_NEAR(1000 * (finger - centre).norm(), 5, 3e-3) << i;  // N at 1000 N/m
  }
}

TEST(CadTouch, AHoleHoldsALargerBallAndLetsASmallerOnePass) {
  const TopoDS_Shape plate = test::bored(2, 1);
  const Vec3 above(0, 0, 10e-3), below(0, 0, -10e-3);
  EXPECT_NEAR(restOf(plate, 3e-3, above, below).z(), 1e-3 + std::sqrt(5.0) * 1e-3, 4e-6);
  // Chords of the bore are up to the deflection inside.
  EXPECT_LT((restOf(plate, 1.997e-3, above, below) - below).norm(), 1e-9);
  EXPECT_GT(restOf(plate, 2.0001e-3, above, below).z(), 0);
}

TEST(CadTouch, ABallAroundASphereIsOneRadiusOutside) {
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(25).Shape();
  const auto scene = makeSnapshot(SceneModel(meshOf(ball, {2e-5, 0.1})));
  ProxySettings settings;
  settings.radius = 1e-3;
  ProxyState state = startProxy(*scene, settings, Vec3(0, 0, 0.03));
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const double turn = 0.05 * i, lift = 1.5 * std::cos(0.013 * i);
    tick(state, *scene, settings,
         0.024 * Vec3(std::cos(turn) * std::cos(lift), std::sin(turn) * std::cos(lift), std::sin(lift)));
    if (i > 20) worst = std::max(worst, std::abs(state.position.norm() - 0.026));
  }
  EXPECT_LT(worst, 2.1e-5);
}

}  // namespace
}  // namespace hl::test_cad_mesh
