// The triangles of a tile that a moving ball may touch: none is left out, and few are there for nothing.
#include "surfaces/tile_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/closest_point.h"
#include "geometry/scenes.h"
#include "instruction_sets.h"
#include "surfaces/depth_camera.h"

namespace hl::test_tile_triangles {
namespace {

using test::Random;

constexpr std::size_t kStride = 12;

/// A tile of depths 1 to 2 with gaps, before a ball of radius 1: its pixels are as large as `cell`.
struct TestTile {
  TestTile(Random& random, double cell_size) : cell(cell_size), depths(kStride * 9 + 8) {
    ball.join = 0.5F;
    for (float& depth : depths) depth = random.below(9) == 0 ? 0 : static_cast<float>(random.uniform(1, 1 + rough));
    const Vec3 middle =
        pointOf(random.below(8), random.below(8), 1.1) + 1.5 * random.uniform(0, 1) * random.direction();
    const Vec3 half = std::pow(10.0, random.uniform(-3, 1)) * random.direction();
    for (std::size_t k = 0; k < 3; ++k) {
      ball.middle[k] = static_cast<float>(middle[static_cast<Eigen::Index>(k)]);
      ball.half[k] = static_cast<float>(half[static_cast<Eigen::Index>(k)]);
      for (int n = 0; n < 9; ++n) {
        ball.column[k][static_cast<std::size_t>(n)] = k == 0 ? static_cast<float>(cell * n) : 0;
        ball.row[k][static_cast<std::size_t>(n)] = k == 1 ? static_cast<float>(cell * n) : k == 2 ? kAway : 0;
      }
    }
  }
  float depthAt(std::size_t i, std::size_t j) const { return depths[j * kStride + i]; }
  Vec3 pointOf(double i, double j, double depth) const { return depth * Vec3(cell * i, cell * j, kAway); }
  Vec3 at(std::size_t i, std::size_t j) const {
    return pointOf(static_cast<double>(i), static_cast<double>(j), depthAt(i, j)) - vectorOf(ball.middle);
  }
  static Vec3 vectorOf(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

  static constexpr float kAway = 20;
  double cell, rough = 0.05;
  std::vector<float> depths;
  TileBall ball;
};

// When the triangle of the tile is within 1 of the way of the ball, to 1/200 of it; above 1: never.
double touchedAt(const std::array<Vec3, 3>& corner, const Vec3& half, double radius) {
  const Primitive triangle = triangleOf(corner[0], corner[1], corner[2], 0);
  for (int i = -100; i <= 100; ++i) {
    if (closestPoint(triangle, 0.01 * i * half).distance <= radius) return 0.01 * i;
  }
  return 2;
}

TEST(TileTriangles, NoneIsLeftOutAndFewAreThereForNothing) {
  Random random(1);
  const DepthCamera camera{1, 1, 0, 0, 0.5};
  std::size_t touched = 0, proposed = 0, late = 0;
  for (int n = 0; n < 300; ++n) {
    const TestTile tile(random, std::pow(10.0, random.uniform(-1.5, 0.5)));
    TileTouches found;
    touchedTriangles(tile.ball, tile.depths.data(), kStride, 8, found);
    for (std::size_t j = 0; j < 8; ++j) {
      for (std::size_t triangle = 0; triangle < TileTouches::kTriangles; ++triangle) {
        const std::size_t i = triangle % 8, half = triangle / 8;
        const std::array<std::array<std::size_t, 2>, 3> at{{{i, j}, {i + 1 - half, j + half}, {i + 1, j + 1}}};
        const auto depth = [&](std::size_t c) { return tile.depthAt(at[c][0], at[c][1]); };
        const bool there = (found.bits[j] >> triangle & 1) != 0;
        if (!camera.joins(depth(0), depth(1), depth(2))) {
          ASSERT_FALSE(there);
          continue;
        }
        const std::array<Vec3, 3> corner{tile.at(at[0][0], at[0][1]), tile.at(at[1][0], at[1][1]),
                                         tile.at(at[2][0], at[2][1])};
        const double time = touchedAt(corner, TestTile::vectorOf(tile.ball.half), 1 - 1e-4);
        proposed += there ? 1 : 0;
        if (time > 1) continue;
        ++touched;
        ASSERT_TRUE(there) << n << " row " << j << " triangle " << triangle;
        ASSERT_LE(found.earliest[j][triangle], time + 1e-6);
        late += found.earliest[j][triangle] >= time - 0.1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(touched, 2000U);
  EXPECT_LT(proposed, 2 * touched);
  EXPECT_GT(late, touched / 2) << "the moments tell something";
}

TEST(TileTriangles, AreTheSameWithEachInstructionSet) {
  Random random(2);
  for (int n = 0; n < 300; ++n) {
    const TestTile tile(random, std::pow(10.0, random.uniform(-1.5, 0.5)));
    TileTouches first;
    touchedTriangles(tile.ball, tile.depths.data(), kStride, 8, first);
    test::withEachInstructionSet([&] {
      TileTouches found;
      touchedTriangles(tile.ball, tile.depths.data(), kStride, 8, found);
      ASSERT_EQ(found.bits, first.bits);
      for (std::size_t j = 0; j < 8; ++j) {
        for (std::size_t triangle = 0; triangle < TileTouches::kTriangles; ++triangle) {
          if ((first.bits[j] >> triangle & 1) == 0) continue;
          ASSERT_EQ(found.earliest[j][triangle], first.earliest[j][triangle]);
        }
      }
    });
  }
}

}  // namespace
}  // namespace hl::test_tile_triangles
