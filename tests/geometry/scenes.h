// Small scenes and random primitives for the tests of src/geometry.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "geometry/make_primitive.h"
#include "geometry/primitives.h"

namespace hl::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  Vec3 inCube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

inline void addTriangle(std::vector<Primitive>& scene, const Vec3& a, const Vec3& b, const Vec3& c) {
  Primitive triangle;
  if (makeTriangle(a, b, c, static_cast<std::uint32_t>(scene.size()), triangle)) scene.push_back(triangle);
}

/// Vertices and index lists, and the primitives that they make.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<std::uint32_t> points;

  MeshView view() const { return {positions, triangles, segments, points}; }
  Primitives primitives() const { return Primitives(view()); }
  std::uint32_t add(const Vec3& position) {
    positions.push_back(position);
    return static_cast<std::uint32_t>(positions.size() - 1);
  }
};

/// A hilly sheet of 2 cells^2 triangles over the unit square.
inline std::vector<Primitive> terrain(int cells) {
  const auto at = [cells](int i, int j) {
    const double x = static_cast<double>(i) / cells;
    const double y = static_cast<double>(j) / cells;
    return Vec3(x, y, 0.05 * std::sin(11 * x) * std::cos(7 * y) + 0.01 * std::sin(41 * x + 29 * y));
  };
  std::vector<Primitive> scene;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      addTriangle(scene, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      addTriangle(scene, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return scene;
}

/// One random primitive of size about `size` within a cube: triangles, needles, segments and points.
inline Primitive randomPrimitive(Random& random, double cube, double size, std::uint32_t source) {
  Primitive primitive;
  const Vec3 a = random.inCube(cube);
  bool made = false;
  while (!made) {
    const Vec3 b = a + random.inCube(size);
    const Vec3 c = a + random.inCube(size);
    const int kind = random.below(10);
    if (kind == 0)
      made = makePoint(a, source, primitive);
    else if (kind == 1)
      made = makeSegment(a, b, source, primitive);
    else if (kind == 2) {
      const double thin = size * std::pow(10.0, random.uniform(-9, -2));
      made = makeTriangle(a, b, a + random.uniform(0, 1) * (b - a) + thin * random.direction(), source, primitive);
    } else
      made = makeTriangle(a, b, c, source, primitive);
  }
  return primitive;
}

/// Random primitives of mixed sizes, some of them twice.
inline std::vector<Primitive> soup(Random& random, std::size_t count, double cube, double size) {
  std::vector<Primitive> scene;
  while (scene.size() < count) {
    const double spread = std::pow(10.0, random.uniform(-1, 0.5));
    scene.push_back(randomPrimitive(random, cube, size * spread, static_cast<std::uint32_t>(scene.size())));
    if (random.below(50) == 0) {
      Primitive copy = scene[static_cast<std::size_t>(random.below(static_cast<int>(scene.size())))];
      copy.source = static_cast<std::uint32_t>(scene.size());
      scene.push_back(copy);
    }
  }
  return scene;
}

}  // namespace hl::test
