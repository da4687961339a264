#include "surfaces/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "surfaces/cloud_index.h"

namespace hl {

namespace {

GridFrame frameOf(const CloudLattice& lattice) { return {lattice.step.asDiagonal(), lattice.origin}; }

}  // namespace

PointCloud::PointCloud(std::shared_ptr<const CloudPoints> points, const GridFrame& frame, const CloudLook& look)
    : cloud_(std::move(points), frame, look) {}

PointCloud::PointCloud(const std::shared_ptr<const CloudPoints>& points, const CloudLook& look)
    : PointCloud(points, frameOf(points->lattice()), look) {}

std::unique_ptr<const SpatialIndex> PointCloud::makeIndex() const { return std::make_unique<CloudIndex>(cloud_); }

double PointCloud::error_m() const { return cloud_.stretch() * points()->error_m(); }

std::shared_ptr<const PrimitiveSource> PointCloud::placed(const Mat3& linear, const Vec3& offset) const {
  return std::make_shared<const PointCloud>(points(), frame().placed(linear, offset), look());
}

// Each second, third ... point; surfels are then drawn larger, so that they cover as much.
DrawnMesh PointCloud::drawn(std::size_t most) const {
  const std::size_t step = std::max<std::size_t>(1, (triangles() + most - 1) / std::max<std::size_t>(1, most));
  const double larger = std::sqrt(static_cast<double>(step));
  DrawnMesh mesh;
  std::size_t number = 0;
  for (std::size_t slot = 0; slot < points()->blocks() * CloudPoints::kPerBlock; ++slot) {
    if (slot % CloudPoints::kPerBlock >= points()->countIn(slot / CloudPoints::kPerBlock) || number++ % step != 0)
      continue;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t vertices = surfels() ? PlacedCloud::kSides : 1;
    mesh.normals.insert(mesh.normals.end(), vertices, cloud_.normalAt(slot));
    if (!surfels()) {
      mesh.positions.push_back(cloud_.pointAt(slot));
      mesh.points.push_back(first);
      continue;
    }
    for (std::size_t i = 0; i < PlacedCloud::kSides; ++i) mesh.positions.push_back(cloud_.corner(slot, i, larger));
    for (std::uint32_t i = 1; i <= PlacedCloud::kPerSurfel; ++i)
      mesh.triangles.push_back(
          {first, first + i + (cloud_.mirrored() ? 1 : 0), first + i + (cloud_.mirrored() ? 0 : 1)});
  }
  return mesh;
}

}  // namespace hl
