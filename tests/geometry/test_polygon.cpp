// Polygons against a judge in whole numbers: every triangle turns as the polygon does, together they have its area, and
// random points within lie in one of them, those outside in none.
#include "geometry/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace hl::test_polygon {
namespace {

using Grid = std::vector<std::pair<int, int>>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

long turn(const std::pair<int, int>& a, const std::pair<int, int>& b, const std::pair<int, int>& c) {
  return static_cast<long>(b.first - a.first) * (c.second - a.second) -
         static_cast<long>(b.second - a.second) * (c.first - a.first);
}

long areaTwice(const Grid& polygon) {
  long sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += turn(polygon[0], polygon[i - 1], polygon[i]);
  return sum;
}

bool between(const std::pair<int, int>& a, const std::pair<int, int>& b, const std::pair<int, int>& p) {
  return turn(a, b, p) == 0 && std::min(a, b) <= p && p <= std::max(a, b);
}

// Whether the closed segments have a point in common.
bool meet(const std::pair<int, int>& a, const std::pair<int, int>& b, const std::pair<int, int>& c,
          const std::pair<int, int>& d) {
  if (between(a, b, c) || between(a, b, d) || between(c, d, a) || between(c, d, b)) return true;
  const auto sign = [](long x) { return (x > 0) - (x < 0); };
  return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

bool isSimple(const Grid& polygon) {
  const std::size_t n = polygon.size();
  const auto at = [&](std::size_t i) { return polygon[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (at(i) == at(i + 1) || between(at(i), at(i + 1), at(i + 2)) || between(at(i + 1), at(i + 2), at(i)))
      return false;
    for (std::size_t k = i + 2; k < n && k + 1 < i + n; ++k) {
      if (meet(at(i), at(i + 1), at(k), at(k + 1))) return false;
    }
  }
  return true;
}

// Of corners on a small grid, so that many lie on one line, or on the line of two others.
Grid randomPolygon(std::mt19937& random, int size) {
  std::uniform_int_distribution<int> place(0, 6);
  while (true) {
    Grid polygon;
    for (int i = 0; i < size; ++i) polygon.emplace_back(place(random), place(random));
    // Crossing edges are exchanged; each exchange makes the outline shorter.
    for (int round = 0; round < 50; ++round) {
      for (std::size_t i = 0; i + 2 < polygon.size(); ++i) {
        for (std::size_t k = i + 2; k < polygon.size(); ++k) {
          if (meet(polygon[i], polygon[i + 1], polygon[k], polygon[(k + 1) % polygon.size()]) &&
              (i > 0 || k + 1 < polygon.size()))
            std::reverse(polygon.begin() + static_cast<long>(i) + 1, polygon.begin() + static_cast<long>(k) + 1);
        }
      }
    }
    if (isSimple(polygon)) return polygon;
  }
}

// On a plane that is not along the axes; affine with factors that are powers of two, so nothing is rounded.
std::vector<Vec3> inSpace(const Grid& polygon) {
  std::vector<Vec3> corners;
  for (const auto& [x, y] : polygon) corners.emplace_back(x + 0.5 * y, 0.25 * x - 2, y - 0.125 * x);
  return corners;
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

bool winds(const Grid& polygon, const Vec2& p) {
  int winding = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a(polygon[i].first, polygon[i].second);
    const auto& [x, y] = polygon[(i + 1) % polygon.size()];
    const Vec2 b(x, y);
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double side = turn(a, b, p);
    if ((side > 0) == (b.y() > a.y())) winding += b.y() > a.y() ? 1 : -1;
  }
  return winding != 0;
}

void expectCoveredOnce(const Grid& polygon, const Triangles& triangles, std::mt19937& random) {
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const long whole = areaTwice(polygon);
  long sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const long area = turn(polygon[a], polygon[b], polygon[c]);
    ASSERT_GT(whole > 0 ? area : -area, 0);
    sum += area;
  }
  ASSERT_EQ(sum, whole);
  std::uniform_real_distribution<double> place(-1, 7);
  for (int i = 0; i < 200; ++i) {
    const Vec2 p(place(random), place(random));
    int covers = 0;
    for (const auto& t : triangles) {
      Grid corners;
      for (const std::uint32_t k : t) corners.push_back(polygon[k]);
      covers += winds(corners, p) ? 1 : 0;
    }
    ASSERT_EQ(covers, winds(polygon, p) ? 1 : 0);
  }
}

TEST(Polygon, RandomOnesAreCoveredOnce) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> sizes(4, 14);
  for (int round = 0; round < 1000; ++round) {
    Grid polygon = randomPolygon(random, sizes(random));
    if (round % 2 == 0) std::reverse(polygon.begin(), polygon.end());
    expectCoveredOnce(polygon, trianglesOf(inSpace(polygon)), random);
  }
}

// The diagonal from the ear at (4, 0) goes through the reflex corner (2, 2).
TEST(Polygon, ACornerOnADiagonalIsNotCutAway) {
  const Grid notched{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}};
  std::mt19937 random(2);
  for (std::size_t first = 0; first < notched.size(); ++first) {
    Grid turned(notched);
    std::rotate(turned.begin(), turned.begin() + static_cast<long>(first), turned.end());
    expectCoveredOnce(turned, trianglesOf(inSpace(turned)), random);
  }
}

// Joined to the outline by an edge that is walked twice, as programs write faces with holes.
TEST(Polygon, AHoleStaysOpen) {
  const Grid outline{{0, 0}, {6, 0}, {6, 6}, {0, 6}};
  std::mt19937 random(3);
  for (std::size_t first = 0; first < outline.size(); ++first) {
    for (const Grid& hole : {Grid{{2, 2}, {2, 4}, {4, 4}, {4, 2}}, Grid{{1, 1}, {1, 5}, {3, 3}, {5, 5}, {5, 1}}}) {
      Grid whole(outline);
      std::rotate(whole.begin(), whole.begin() + static_cast<long>(first), whole.end());
      Grid inner(hole);
      const auto far = [&](const auto& p) {
        return std::pair(std::abs(p.first - whole[0].first) + std::abs(p.second - whole[0].second), p);
      };
      std::rotate(
          inner.begin(),
          std::min_element(inner.begin(), inner.end(), [&](const auto& a, const auto& b) { return far(a) < far(b); }),
          inner.end());
      whole.push_back(whole[0]);
      whole.insert(whole.end(), inner.begin(), inner.end());
      whole.push_back(inner[0]);
      expectCoveredOnce(whole, trianglesOf(inSpace(whole)), random);
    }
  }
}

// What is no polygon still gives triangles of its own corners.
TEST(Polygon, WhatIsNoneEnds) {
  EXPECT_TRUE(trianglesOf(std::vector<Vec3>(2, Vec3::Zero())).empty());
  EXPECT_EQ(trianglesOf(std::vector<Vec3>(7, Vec3::Ones())).size(), 5u);
  EXPECT_EQ(trianglesOf(inSpace({{0, 0}, {1, 0}, {2, 0}, {3, 0}})).size(), 2u);
  EXPECT_EQ(trianglesOf(inSpace({{0, 0}, {2, 2}, {2, 0}, {0, 2}})).size(), 2u);  // crosses itself
  const double nan = std::nan("");
  EXPECT_EQ(trianglesOf(std::vector<Vec3>(6, Vec3::Constant(nan))).size(), 4u);
}

// Convex ones, of which most are quads, are a fan.
TEST(Polygon, AConvexOneIsAFan) {
  const Triangles fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_EQ(trianglesOf(inSpace({{0, 0}, {3, 0}, {4, 2}, {2, 4}, {0, 3}})), fan);
}

}  // namespace
}  // namespace hl::test_polygon
