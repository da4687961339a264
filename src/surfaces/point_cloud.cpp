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

// Each second, third ... point; surfels are then drawn larger, so that they cover as much. Points are drawn as surfels
// that leave gaps, so that their normals are seen.
DrawnMesh PointCloud::drawn(std::size_t most) const {
  constexpr double kReachOfPoints = 0.4;
  const std::size_t all = points()->size() * PlacedCloud::kPerSurfel;
  const std::size_t step = std::max<std::size_t>(
      1, all / std::max<std::size_t>(1, most) + (all % std::max<std::size_t>(1, most) > 0 ? 1 : 0));
  const double larger = std::sqrt(static_cast<double>(step)) * (surfels() ? 1 : kReachOfPoints / look().reach);
  const std::uint32_t turned = cloud_.mirrored() ? 1 : 0;
  DrawnMesh mesh;
  std::size_t number = 0;
  for (std::size_t slot = 0; slot < points()->blocks() * CloudPoints::kPerBlock; ++slot) {
    if (slot % CloudPoints::kPerBlock >= points()->countIn(slot / CloudPoints::kPerBlock) || number++ % step != 0)
      continue;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    if (hasColours()) mesh.colours.insert(mesh.colours.end(), PlacedCloud::kSides, points()->colour(slot));
    mesh.normals.insert(mesh.normals.end(), PlacedCloud::kSides, cloud_.normalAt(slot));
    for (std::size_t i = 0; i < PlacedCloud::kSides; ++i) mesh.positions.push_back(cloud_.corner(slot, i, larger));
    for (std::uint32_t i = 1; i <= PlacedCloud::kPerSurfel; ++i)
      mesh.triangles.push_back({first, first + i + turned, first + i + 1 - turned});
  }
  return mesh;
}

}  // namespace hl
