// PointCloud: the points of a cloud as primitives, or each as a surfel: a small hexagon in the plane of its normal.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "geometry/primitive_source.h"
#include "surfaces/cloud_points.h"
#include "surfaces/grid_frame.h"

namespace hl {

/// How a cloud is touched.
enum class CloudForm : std::uint8_t { kPoints, kSurfels };

struct CloudLook {
  CloudForm form = CloudForm::kPoints;
  /// Of surfels: a disc of so many times the spacing around the point lies within its hexagon. Of a square grid 0.71
  /// covers all.
  double reach = 0.75;
};

/// Primitives are numbered by the slots of the points; those of surfels four to a slot. Immutable; shares the points
/// with its copies in other places and forms.
class PointCloud final : public PrimitiveSource {
 public:
  static constexpr std::size_t kPerSurfel = 4, kSides = 6;

  /// `frame`: from steps of the lattice to metres. Throws hl::Error where the cloud lies beyond 1e9 m, and for axes
  /// that flatten it or a reach that is not from 0.01 to 10.
  PointCloud(std::shared_ptr<const CloudPoints> points, const GridFrame& frame, const CloudLook& look);
  /// Where the points are by their lattice.
  PointCloud(const std::shared_ptr<const CloudPoints>& points, const CloudLook& look);

  PrimitiveKind kind() const override { return surfels() ? PrimitiveKind::kTriangle : PrimitiveKind::kPoint; }
  ElementId count() const override { return points_->blocks() * CloudPoints::kPerBlock * perPoint(); }
  std::uint64_t triangles() const override { return points_->size() * perPoint(); }
  std::array<Vec3, 3> corners(ElementId id) const override;
  /// Of the point.
  Vec3 trueNormal(ElementId id, const Vec3& /*point*/) const override { return normalAt(id / perPoint()); }
  bool hasOutside() const override { return false; }
  Box bounds() const override { return bounds_; }
  std::unique_ptr<const SpatialIndex> makeIndex() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  SharedMemory shared() const override { return {points_.get(), points_->bytes()}; }
  /// Between a point and where the file has it. How far the points are from the matter no file tells.
  double error_m() const override;
  std::shared_ptr<const PrimitiveSource> placed(const Mat3& linear, const Vec3& offset) const override;
  DrawnMesh drawn(std::size_t most) const override;

  const std::shared_ptr<const CloudPoints>& points() const { return points_; }
  const GridFrame& frame() const { return frame_; }
  const CloudLook& look() const { return look_; }
  bool surfels() const { return look_.form == CloudForm::kSurfels; }
  std::size_t perPoint() const { return surfels() ? kPerSurfel : 1; }
  /// m, in the frame of the object: no primitive of a point of this block reaches farther from it.
  double reachOf(std::size_t block) const { return surfels() ? stretch_ * circumradius(block) : 0; }
  /// Of all blocks.
  double largestReach() const { return largest_reach_; }
  double largestStretch() const { return stretch_; }
  /// Of the coordinates of corners, m, at most.
  double rounding() const { return rounding_; }
  /// Unit, in the frame of the object. RT-safe.
  Vec3 normalAt(std::size_t slot) const { return (for_normals_ * unpackNormal(points_->normal(slot))).normalized(); }

 private:
  double circumradius(std::size_t block) const;
  Vec3 pointAt(std::size_t slot) const;
  /// From the plane of the surfel to the frame of the object.
  Vec3 corner(std::size_t slot, std::size_t number, double larger) const;

  std::shared_ptr<const CloudPoints> points_;
  GridFrame frame_;
  CloudLook look_;
  Mat3 linear_, for_normals_;  // from metres along the axes of the lattice; its inverse transpose
  bool mirrored_ = false;
  double stretch_ = 1, least_radius_ = 0, largest_reach_ = 0, rounding_ = 0;
  Box bounds_;
};

}  // namespace hl
