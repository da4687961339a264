// PointCloud: the points of a cloud as primitives, or the triangles of its surfels (placed_cloud.h).
#pragma once

#include <array>
#include <memory>

#include "geometry/primitive_source.h"
#include "surfaces/placed_cloud.h"

namespace hl {

/// Immutable; shares the points with its copies in other places and forms.
class PointCloud final : public PrimitiveSource {
 public:
  /// As PlacedCloud.
  PointCloud(std::shared_ptr<const CloudPoints> points, const GridFrame& frame, const CloudLook& look);
  /// Where the points are by their lattice.
  PointCloud(const std::shared_ptr<const CloudPoints>& points, const CloudLook& look);

  PrimitiveKind kind() const override { return surfels() ? PrimitiveKind::kTriangle : PrimitiveKind::kPoint; }
  ElementId count() const override { return points()->blocks() * CloudPoints::kPerBlock * perPoint(); }
  std::uint64_t triangles() const override { return points()->size() * perPoint(); }
  std::array<Vec3, 3> corners(ElementId id) const override { return cloud_.corners(id); }
  /// Of the point.
  Vec3 trueNormal(ElementId id, const Vec3& /*point*/) const override { return cloud_.normalAt(id / perPoint()); }
  bool hasOutside() const override { return false; }
  bool hasColours() const override { return points()->hasColours(); }
  Box bounds() const override { return cloud_.bounds(); }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  SharedMemory shared() const override { return {points().get(), points()->bytes()}; }
  /// Between a point and where the file has it. No file gives how far the points are from the matter.
  double error_m() const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most) const override;

  const PlacedCloud& cloud() const { return cloud_; }
  const std::shared_ptr<const CloudPoints>& points() const { return cloud_.points(); }
  const GridFrame& frame() const { return cloud_.frame(); }
  const CloudLook& look() const { return cloud_.look(); }
  bool surfels() const { return cloud_.surfels(); }
  std::size_t perPoint() const { return cloud_.perPoint(); }
  /// Distance of most points from their neighbours, m.
  double spacing() const { return cloud_.stretch() * points()->usualSpacing(); }

 private:
  PlacedCloud cloud_;
};

}  // namespace hl
