// Scenes of the surface tests, small enough to know their answers by formula.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>

#include "scene/snapshot.h"

namespace hl::test {

/// The paper's Figure 6: a prism over a regular polygon of `sides` corners at radius R = 1 about z, with radial vertex
/// normals, 2 m long.
inline std::shared_ptr<const Snapshot> prism(std::uint32_t sides = 10) {
  Model model;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = M_PI / sides * (2.0 * i + 1);  // corner i is between faces i and i + 1; face 0 looks along +x
    const Vec3 radial(std::cos(angle), std::sin(angle), 0);
    for (const double z : {-1.0, 1.0}) {
      model.positions.push_back(radial + z * Vec3::UnitZ());
      model.normals.push_back(radial);
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    model.triangles.push_back({a, b, b + 1});
    model.triangles.push_back({a, b + 1, a + 1});
  }
  return makeSnapshot(std::move(model), HierarchyKind::kNone);
}

/// Adds a rectangle with corners a, a + u, a + u + v, a + v, texture coordinates 0..1 along u and v, and one normal.
inline void addRectangle(Model& model, const Vec3& a, const Vec3& u, const Vec3& v, const Vec3& normal) {
  const auto base = static_cast<std::uint32_t>(model.positions.size());
  const std::array<Vec3, 4> corners{a, a + u, a + u + v, a + v};
  const std::array<Vec2, 4> texcoords{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  for (std::size_t i = 0; i < 4; ++i) {
    model.positions.push_back(corners[i]);
    model.normals.push_back(normal);
    model.texcoords.push_back(texcoords[i]);
  }
  model.triangles.push_back({base, base + 1, base + 2});
  model.triangles.push_back({base, base + 2, base + 3});
}

/// A square floor y = 0, 0.2 m wide about the origin, whose vertex normals all are `normal`. u along x, v along -z.
inline Model floorModel(const Vec3& normal = Vec3::UnitY()) {
  Model model;
  addRectangle(model, {-0.1, 0, 0.1}, {0.2, 0, 0}, {0, 0, -0.2}, normal.normalized());
  return model;
}

/// Two walls that meet along the x axis and open upward by `opening` radians, 0.2 m long.
inline std::shared_ptr<const Snapshot> groove(double opening) {
  Model model;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 up(0, std::cos(opening / 2), side * std::sin(opening / 2));
    addRectangle(model, {-0.1, 0, 0}, {0.2, 0, 0}, 0.1 * up,
                 Vec3(0, std::sin(opening / 2), -side * std::cos(opening / 2)));
  }
  return makeSnapshot(std::move(model), HierarchyKind::kNone);
}

inline std::shared_ptr<const Snapshot> snapshotOf(Model model) {
  return makeSnapshot(std::move(model), HierarchyKind::kNone);
}

}  // namespace hl::test
