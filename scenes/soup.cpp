#include "soup.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "base/plain_math.h"

namespace hl {

namespace {

constexpr double kSoupSide = 0.2;  // m

// The distributions of the standard library differ between implementations; this function does not. Range -1..1.
double uniform(std::mt19937_64& random) { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; }

Vec3 inCube(std::mt19937_64& random) {
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

Vec3 direction(std::mt19937_64& random) {
  while (true) {
    const Vec3 v = inCube(random);
    if (v.norm() > 0.1 && v.norm() <= 1) return v.normalized();
  }
}

}  // namespace

Model makeSoup(std::size_t triangles) {
  std::mt19937_64 random(1997);
  const double edge = kSoupSide / plain::cubeRoot(static_cast<double>(triangles));
  // A single triangle would be as large as the box and extend beyond it.
  const double reach = std::min(edge / std::sqrt(3.0), 0.25 * kSoupSide);  // m, from the centre to a vertex
  Model model;
  model.positions.reserve(3 * triangles);
  model.normals.reserve(3 * triangles);
  model.triangles.reserve(triangles);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3 middle = (0.5 * kSoupSide - reach) * inCube(random);
    const Vec3 normal = direction(random);
    const Vec3 u = normal.cross(direction(random)).normalized();
    const Vec3 v = normal.cross(u);
    for (int corner = 0; corner < 3; ++corner) {
      const double angle = 2 * M_PI / 3 * corner;
      model.positions.push_back(middle + reach * (plain::cos(angle) * u + plain::sin(angle) * v));
      model.normals.push_back(normal);
    }
    model.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return model;
}

}  // namespace hl
