// Solids: closed, with normals that point outward, and of the volume that a formula gives.
#include "solids.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace hl::test_solids {
namespace {

double volumeOf(const Model& model) {
  double six = 0;
  for (const auto& t : model.triangles)
    six += model.positions[t[0]].dot(model.positions[t[1]].cross(model.positions[t[2]]));
  return six / 6;
}

std::array<double, 3> placeOf(const Vec3& p) {
  const auto rounded = [](double x) { return std::round(1e9 * x); };
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

// Each edge belongs to one triangle in this direction and to one in the other.
void expectClosed(const Model& model) {
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> edges;
  for (const auto& t : model.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      ++edges[{placeOf(model.positions[t[i]]), placeOf(model.positions[t[(i + 1) % 3]])}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

void expectOutward(const Model& model) {
  for (const auto& t : model.triangles) {
    const Vec3 face =
        (model.positions[t[1]] - model.positions[t[0]]).cross(model.positions[t[2]] - model.positions[t[0]]);
    EXPECT_GT(face.norm(), 0);
    for (const std::uint32_t v : t) EXPECT_GT(model.normals[v].dot(face.normalized()), 0.5);
  }
}

TEST(Solids, ABoxIsClosedAndHasItsVolume) {
  const Model box = boxSolid(Vec3(0.01, 0.02, 0.03));
  EXPECT_EQ(box.triangles.size(), 12u);
  expectClosed(box);
  expectOutward(box);
  EXPECT_NEAR(volumeOf(box), 8 * 0.01 * 0.02 * 0.03, 1e-15);
}

TEST(Solids, ACylinderIsAPrismOfItsSides) {
  const Model cylinder = cylinderSolid(0.01, 0.02, 32);
  expectClosed(cylinder);
  expectOutward(cylinder);
  const double base = 16 * 0.01 * 0.01 * std::sin(std::numbers::pi / 16);
  EXPECT_NEAR(volumeOf(cylinder), base * 0.04, 1e-15);
}

TEST(Solids, ABallComesNearToItsVolume) {
  const Model ball = ballSolid(0.01, 48);
  expectClosed(ball);
  expectOutward(ball);
  EXPECT_NEAR(volumeOf(ball) / (4 * std::numbers::pi / 3 * 1e-6), 1, 0.01);
}

TEST(Solids, AProfileThatTurnsInwardIsABowl) {
  const Model bowl = turnedSolid({{0, -0.01}, {0.02, 0.01}, {0.018, 0.01}, {0, -0.008}}, 24, false);
  expectClosed(bowl);
  expectOutward(bowl);
  EXPECT_GT(volumeOf(bowl), 0);
}

}  // namespace
}  // namespace hl::test_solids
