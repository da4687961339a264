// Scenes of the tests of what moves: boxes, plates and sheets, each placed where its motion says.
#pragma once

#include <cstdint>
#include <memory>

#include "effect_scenes.h"
#include "scene/snapshot.h"

namespace hl::test {

inline Model rectangle(const Vec3& corner, const Vec3& u, const Vec3& v) {
  Model model;
  addRectangle(model, corner, u, v, u.cross(v).normalized());
  return model;
}

inline Model boxModel(const Vec3& half) {
  Model model;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 u = Vec3::Zero(), v = Vec3::Zero(), n = Vec3::Zero();
      n[axis] = side * half[axis];
      u[(axis + 1) % 3] = half[(axis + 1) % 3];
      v[(axis + 2) % 3] = half[(axis + 2) % 3];
      addRectangle(model, n - u - v, 2 * u, 2 * v, n.normalized());
    }
  }
  return model;
}

/// A sheet of 0.1 m x 0.1 m about the origin, at y = height(x, z).
template <typename Height>
Model sheet(const Height& height, int cells = 40) {
  Model model;
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      const double x = 0.1 * i / cells - 0.05, z = 0.1 * k / cells - 0.05;
      model.positions.emplace_back(x, height(x, z), z);
    }
  }
  const auto at = [cells](int i, int k) { return static_cast<std::uint32_t>(i * (cells + 1) + k); };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      model.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      model.triangles.push_back({at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)});
    }
  }
  return model;
}
inline Model flatSheet(double height) {
  return sheet([height](double, double) { return height; });
}

inline Instance place(std::uint64_t key, Model model, const Motion& motion) {
  Instance instance;
  instance.key = key;
  instance.shape = makeShape(std::move(model), HierarchyKind::kBvh);
  instance.surfaces = surfacesOf(instance.shape);
  instance.motion = motion;
  return instance;
}

/// A mesh that bends from one model to another of the same index lists.
inline Instance deforming(std::uint64_t key, Model from, Model to, std::int64_t begin_ns, std::int64_t end_ns) {
  Instance instance = place(key, std::move(from), Motion());
  const auto before = instance.shape;
  instance.shape = makeShape(std::move(to), *before);
  instance.mesh_motion = std::make_shared<MeshMotion>(MeshTransition(before, instance.shape, begin_ns, end_ns));
  return instance;
}

inline Pose at(const Vec3& origin) { return {Mat3::Identity(), origin}; }
inline Pose turned(double angle, const Vec3& axis) {
  return {Eigen::AngleAxisd(angle, axis).toRotationMatrix(), Vec3::Zero()};
}

}  // namespace hl::test
