#include "surfaces.h"

#include <algorithm>
#include <cmath>

#include "base/plain_math.h"

namespace hl {

namespace {

constexpr double kSide = 0.2;         // m
constexpr double kDifference = 1e-5;  // of u and v, for the normals

Vec3 normalOf(const std::function<Vec3(double, double)>& surface, double u, double v) {
  // Kept away from the ends: at a pole one derivative vanishes, and the normal close to it is the same.
  const double a = std::clamp(u, 2 * kDifference, 1 - 2 * kDifference);
  const double b = std::clamp(v, 2 * kDifference, 1 - 2 * kDifference);
  const Vec3 du = surface(a + kDifference, b) - surface(a - kDifference, b);
  const Vec3 dv = surface(a, b + kDifference) - surface(a, b - kDifference);
  return du.cross(dv).normalized();
}

void addTriangle(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vec3& p = model.positions[a];
  const Vec3 area = (model.positions[b] - p).cross(model.positions[c] - p);
  const double size = (model.positions[b] - p).squaredNorm() + (model.positions[c] - p).squaredNorm();
  if (area.norm() > 1e-9 * size) model.triangles.push_back({a, b, c});
}

std::uint32_t cells(std::size_t triangles) {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(static_cast<double>(triangles) / 2))));
}

}  // namespace

Model makeSurface(std::uint32_t nu, std::uint32_t nv, const std::function<Vec3(double, double)>& surface) {
  Model model;
  for (std::uint32_t j = 0; j <= nv; ++j) {
    for (std::uint32_t i = 0; i <= nu; ++i) {
      const double u = static_cast<double>(i) / nu;
      const double v = static_cast<double>(j) / nv;
      model.positions.push_back(surface(u, v));
      model.normals.push_back(normalOf(surface, u, v));
      model.texcoords.emplace_back(u, v);
    }
  }
  for (std::uint32_t j = 0; j < nv; ++j) {
    for (std::uint32_t i = 0; i < nu; ++i) {
      const std::uint32_t a = j * (nu + 1) + i;
      addTriangle(model, a, a + 1, a + nu + 2);
      addTriangle(model, a, a + nu + 2, a + nu + 1);
    }
  }
  return model;
}

Model makeTerrain(std::size_t triangles) {
  const std::uint32_t n = cells(triangles);
  return makeSurface(n, n, [](double u, double v) {
    const double x = kSide * (u - 0.5);
    const double z = kSide * (0.5 - v);
    const double y = 0.009 * plain::sin(40 * x + 0.4) * plain::cos(33 * z) + 0.004 * plain::sin(87 * x + 51 * z) +
                     0.0015 * plain::sin(190 * x - 0.8) * plain::sin(170 * z + 0.3);
    return Vec3(x, y, z);
  });
}

Model makeBumpySphere(std::size_t triangles) {
  const std::uint32_t n = cells(triangles / 2);
  return makeSurface(2 * std::max(2u, n), std::max(2u, n), [](double u, double v) {
    const double azimuth = 2 * M_PI * u;
    const double polar = M_PI * (1 - v);
    const Vec3 d(plain::sin(polar) * plain::sin(azimuth), plain::cos(polar), plain::sin(polar) * plain::cos(azimuth));
    return Vec3((0.1 + 0.004 * plain::sin(22 * d.x()) * plain::sin(19 * d.y() + 0.5) * plain::sin(24 * d.z())) * d);
  });
}

Model makePlane(std::size_t triangles) {
  const std::uint32_t n = cells(triangles);
  return makeSurface(n, n, [](double u, double v) { return Vec3(kSide * (u - 0.5), 0, kSide * (0.5 - v)); });
}

Model makePits(std::size_t triangles) {
  // Ridges and valleys lie on grid lines, where the mesh can be sharp.
  constexpr std::uint32_t kWaves = 10;
  const std::uint32_t n = 2 * kWaves * std::max(1u, (cells(triangles) + kWaves) / (2 * kWaves));
  return makeSurface(n, n, [](double u, double v) {
    // From -1 in the valleys to 1 on the ridges.
    const auto wave = [](double w) { return 4 * std::abs(kWaves * w - std::floor(kWaves * w) - 0.5) - 1; };
    return Vec3(kSide * (u - 0.5), 0.005 * (wave(u) + wave(v)), kSide * (0.5 - v));
  });
}

Model makeHalfPipe(std::size_t triangles) {
  const std::uint32_t n = cells(triangles);
  return makeSurface(n, n, [](double u, double v) {
    return Vec3(-0.5 * kSide * plain::cos(M_PI * u), -0.5 * kSide * plain::sin(M_PI * u), kSide * (0.5 - v));
  });
}

}  // namespace hl
