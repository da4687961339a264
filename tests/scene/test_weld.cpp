// Welding: what is the same to the bit becomes one vertex, and nothing else changes.
#include "scene/weld.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

namespace hl::test_weld {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Weld, SameBitsAreJoinedAndElementsKeepTheirOrder) {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  model.triangles = {{5, 3, 4}, {0, 1, 2}};
  model.segments = {{3, 1}};
  model.points = {4, 2};
  EXPECT_EQ(weldVertices(model), 2u);
  EXPECT_EQ(model.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}));
  EXPECT_EQ(model.triangles, (std::vector<std::array<std::uint32_t, 3>>{{3, 0, 2}, {0, 1, 2}}));
  EXPECT_EQ(model.segments, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}}));
  EXPECT_EQ(model.points, (std::vector<std::uint32_t>{2, 2}));
  EXPECT_EQ(weldVertices(model), 0u);
}

TEST(Weld, AnyDifferenceKeepsVerticesApart) {
  Model model;
  model.positions.assign(4, Vec3(1, 2, 3));
  model.normals = {{0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 0, 1}};
  model.texcoords = {{0, 0}, {0, 0}, {0, 0}, {1, 0}};
  model.points = {0, 1, 2, 3};
  EXPECT_EQ(weldVertices(model), 1u);
  EXPECT_EQ(model.points, (std::vector<std::uint32_t>{0, 0, 1, 2}));
  EXPECT_EQ(model.normals[1], Vec3(0, 1, 0));
  EXPECT_EQ(model.texcoords[2], Vec2(1, 0));
}

TEST(Weld, ZerosOfBothSignsStayApartAndIndicesOutOfRangeStayThere) {
  Model model;
  model.positions = {{0.0, 0, 0}, {-0.0, 0, 0}, {kNan, 0, 0}, {kNan, 0, 0}};
  model.triangles = {{0, 1, 77}, {2, 3, 4}};
  EXPECT_EQ(weldVertices(model), 1u);
  EXPECT_EQ(model.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 77}, {2, 2, 4}}));
}

TEST(Weld, EveryElementHasTheVerticesThatItHad) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    Model model;
    const unsigned places = 1 + random() % 40;
    for (int i = 0; i < 200; ++i) {
      model.positions.emplace_back(random() % places, 0.1 * (random() % 3), -1.0);
      model.normals.emplace_back(0, random() % 2, 1);
    }
    for (int i = 0; i < 100; ++i)
      model.triangles.push_back({static_cast<std::uint32_t>(random() % 200), static_cast<std::uint32_t>(random() % 200),
                                 static_cast<std::uint32_t>(random() % 200)});
    const Model before = model;
    const std::size_t joined = weldVertices(model);
    EXPECT_EQ(model.positions.size() + joined, 200u);
    EXPECT_EQ(model.normals.size(), model.positions.size());
    for (std::size_t i = 0; i < 100; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t was = before.triangles[i][k], is = model.triangles[i][k];
        ASSERT_EQ(before.positions[was], model.positions[is]);
        ASSERT_EQ(before.normals[was], model.normals[is]);
      }
    }
  }
}

}  // namespace
}  // namespace hl::test_weld
