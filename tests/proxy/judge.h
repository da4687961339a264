// Judges of a tick that share nothing with it but the closest point and the solver, each judged on its own:
// how near the surface is, and how far the proxy is from a local minimum.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/closest_point.h"
#include "geometry/queries.h"
#include "proxy/proxy.h"
#include "proxy/solver.h"
#include "scene/snapshot.h"

namespace hl::judge {

/// Smallest distance from p to a primitive within `reach`, or `reach`.
inline double clearance(const SceneAt& scene, const Vec3& p, double reach) {
  double nearest = reach;
  scene.primitivesWithin(p, reach,
                         [&](PrimitiveId, const ClosestPoint& c) { nearest = std::min(nearest, c.distance); });
  return nearest;
}

/// The part of finger - p that no contact within radius (1 + 1e-6) resists, as a fraction of it.
inline double kktResidual(const SceneAt& scene, const Vec3& p, const Vec3& finger, double radius) {
  const double gap = (finger - p).norm();
  if (gap < 1e-9 * radius) return 0;
  std::vector<Plane> planes;
  scene.primitivesWithin(p, radius * (1 + 1e-6), [&](PrimitiveId, const ClosestPoint& c) {
    planes.push_back({c.normal, 0});
  });
  return nearestAbove(planes, (finger - p) / gap, 1e-12).point.norm();
}

/// A rectangle of nx by ny cells of two triangles each, with its points mapped by `map(u, v)`, u and v in 0..1.
template <typename Map>
Model grid(std::uint32_t nx, std::uint32_t ny, Map map) {
  Model model;
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) model.positions.push_back(map(double(i) / nx, double(j) / ny));
  }
  for (std::uint32_t j = 0; j < ny; ++j) {
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i;
      model.triangles.push_back({a, a + 1, a + nx + 2});
      model.triangles.push_back({a, a + nx + 2, a + nx + 1});
    }
  }
  return model;
}

/// A soup: every triangle with vertices of its own.
inline Model triangles(const std::vector<std::array<Vec3, 3>>& soup) {
  Model model;
  for (const auto& t : soup) {
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    model.positions.insert(model.positions.end(), t.begin(), t.end());
    model.triangles.push_back({first, first + 1, first + 2});
  }
  return model;
}

inline std::shared_ptr<const Snapshot> scene(Model model, HierarchyKind kind = HierarchyKind::kBvh) {
  return makeSnapshot(std::move(model), kind);
}

}  // namespace hl::judge
