// Mesh drawings: meshes of several solids.
#pragma once

#include "base/plain_math.h"
#include "test_worlds.h"

namespace hl::test {

/// The other's triangles with vertices of their own.
inline void addMesh(Model& model, const Model& other, const Vec3& at = Vec3::Zero()) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  for (const Vec3& vertex : other.positions) model.positions.emplace_back(at + vertex);
  for (const auto& corners : other.triangles)
    model.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
}

inline Model boxesModel(const std::vector<std::pair<Vec3, Vec3>>& half_and_middle) {
  Model model;
  for (const auto& [half, middle] : half_and_middle) addMesh(model, boxModel(half), middle);
  return model;
}

/// Along y, of this many wedges, which have their corners in common.
inline Model ringModel(double inner_m, double outer_m, double half_height_m, int wedges) {
  Model model;
  for (int i = 0; i < wedges; ++i) {
    for (const double radius : {inner_m, outer_m}) {
      for (const double y : {-half_height_m, half_height_m}) {
        const double angle = 2 * EIGEN_PI * i / wedges;
        model.positions.emplace_back(radius * plain::cos(angle), y, radius * plain::sin(angle));
      }
    }
  }
  for (int i = 0; i < wedges; ++i) {
    // Corners of a wedge: bit 0 above, bit 1 outside, bit 2 of its far end.
    const auto corner = [&](int number) {
      return static_cast<std::uint32_t>(4 * ((i + (number >> 2)) % wedges) + (number & 3));
    };
    for (const auto& [a, b, c, d] :
         {std::array{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}) {
      model.triangles.push_back({corner(a), corner(b), corner(c)});
      model.triangles.push_back({corner(a), corner(c), corner(d)});
    }
  }
  return model;
}

/// Open above, outer sides of 2 half_m, walls and bottom as thick; the bottom's lower side at y = 0.
inline Model cupModel(double half_m, double height_m, double thick_m) {
  const double t = thick_m / 2, wall = height_m / 2;
  return boxesModel({{Vec3(half_m, t, half_m), Vec3(0, t, 0)},
                     {Vec3(t, wall, half_m), Vec3(half_m - t, wall, 0)},
                     {Vec3(t, wall, half_m), Vec3(t - half_m, wall, 0)},
                     {Vec3(half_m, wall, t), Vec3(0, wall, half_m - t)},
                     {Vec3(half_m, wall, t), Vec3(0, wall, t - half_m)}});
}

}  // namespace hl::test
