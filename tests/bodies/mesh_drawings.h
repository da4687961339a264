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

/// A closed curve of the half plane x > 0 (x, y), turned about the y axis; counterclockwise, or it faces inward. Points
/// with x = 0 lie on the axis.
inline Model turnedModel(const std::vector<Eigen::Vector2d>& outline, int around) {
  Model model;
  const auto corners = static_cast<std::uint32_t>(outline.size());
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * EIGEN_PI * i / around;
    for (const Eigen::Vector2d& at : outline)
      model.positions.emplace_back(at.x() * plain::cos(angle), at.y(), -at.x() * plain::sin(angle));
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(around); ++i) {
    const std::uint32_t here = i * corners, next = (i + 1) % static_cast<std::uint32_t>(around) * corners;
    for (std::uint32_t j = 0; j < corners; ++j) {
      const std::uint32_t k = (j + 1) % corners;
      if (outline[j].x() > 0) model.triangles.push_back({here + j, next + j, next + k});
      if (outline[k].x() > 0) model.triangles.push_back({here + j, next + k, here + k});
    }
  }
  return model;
}

/// About the y axis.
inline Model torusModel(double ring_m, double tube_m, int around, int across) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < across; ++i) {
    const double angle = 2 * EIGEN_PI * i / across;
    outline.emplace_back(ring_m + tube_m * plain::cos(angle), tube_m * plain::sin(angle));
  }
  return turnedModel(outline, around);
}

/// A round cup in one piece, open above, that widens by a tenth; its bottom's lower side at y = 0.
inline Model beakerModel(double radius_m, double height_m, double thick_m, int around) {
  return turnedModel({{0, 0},
                      {radius_m, 0},
                      {1.1 * radius_m, height_m},
                      {1.1 * radius_m - thick_m, height_m},
                      {radius_m - thick_m, thick_m},
                      {0, thick_m}},
                     around);
}

}  // namespace hl::test
