#include "teapot.h"

#include <array>
#include <utility>

#include "surfaces.h"
#include "teapot_patches.h"

namespace hl {

namespace {

constexpr double kWidth = 0.2;            // m
constexpr double kNewellWidth = 6.43334;  // from the handle at x = -3 to the tip of the spout
const Vec3 kNewellCentre(0.21667, 0, 1.575);

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

// A point of the patch, in metres, y up.
Vec3 evaluate(const std::array<int, 16>& patch, double u, double v) {
  const auto bu = bernstein(u);
  const auto bv = bernstein(v);
  Vec3 p = Vec3::Zero();
  for (std::size_t i = 0; i < 16; ++i) {
    const auto& c = kTeapotPoints[static_cast<std::size_t>(patch[i] - 1)];
    p += bv[i / 4] * bu[i % 4] * Vec3(c[0], c[1], c[2]);
  }
  p = (p - kNewellCentre) * (kWidth / kNewellWidth);
  return {p.x(), p.z(), -p.y()};
}

void append(Model& model, const Model& part) {
  const auto base = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), part.positions.begin(), part.positions.end());
  model.normals.insert(model.normals.end(), part.normals.begin(), part.normals.end());
  model.texcoords.insert(model.texcoords.end(), part.texcoords.begin(), part.texcoords.end());
  for (const auto& t : part.triangles) model.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

}  // namespace

Model makeTeapot(int around, int along) {
  Model model;
  model.name = "teapot";
  for (const auto& patch : kTeapotPatches) {
    append(model, makeSurface(static_cast<std::uint32_t>(around), static_cast<std::uint32_t>(along),
                              [&](double u, double v) { return evaluate(patch, u, v); }));
  }
  return model;
}

}  // namespace hl
