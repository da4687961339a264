// PlacedCloud: the points of a cloud where they lie, and the surfel of each: a small hexagon in the plane of its
// normal.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "geometry/box.h"
#include "geometry/element_id.h"
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

/// Primitives are numbered by the slots of the points; those of surfels four to a slot. Immutable. All is RT-safe but
/// making it. Metres, frame of the object.
class PlacedCloud {
 public:
  static constexpr std::size_t kPerSurfel = 4, kSides = 6;

  /// `frame`: from steps of the lattice to metres. Throws hl::Error where the cloud lies beyond 1e9 m, and for axes
  /// that flatten it or a reach that is not from 0.01 to 10.
  PlacedCloud(std::shared_ptr<const CloudPoints> points, const GridFrame& frame, const CloudLook& look);

  const std::shared_ptr<const CloudPoints>& points() const { return points_; }
  const GridFrame& frame() const { return frame_; }
  const CloudLook& look() const { return look_; }
  bool surfels() const { return look_.form == CloudForm::kSurfels; }
  std::size_t perPoint() const { return surfels() ? kPerSurfel : 1; }
  const Box& bounds() const { return bounds_; }

  /// Of a point three times itself.
  std::array<Vec3, 3> corners(ElementId id) const;
  Vec3 pointAt(std::size_t slot) const;
  Vec3 normalAt(std::size_t slot) const { return normalOf(points_->normal(slot)); }
  /// Of a normal as the points have it.
  Vec3 normalOf(std::uint32_t packed) const { return (for_normals_ * unpackNormal(packed)).normalized(); }
  /// A corner of a surfel that is so many times larger.
  Vec3 corner(std::size_t slot, std::size_t number, double larger = 1) const;
  /// Whether corners are seen clockwise from where the normal points to.
  bool mirrored() const { return mirrored_; }

  /// No primitive of a point of this block, or of any, reaches farther from it.
  double reachOf(std::size_t block) const { return surfels() ? stretch_ * circumradius(block) : 0; }
  double largestReach() const { return largest_reach_; }
  /// The longest that a metre becomes.
  double stretch() const { return stretch_; }
  /// Of the coordinates of corners, at most.
  double rounding() const { return rounding_; }

 private:
  double circumradius(std::size_t block) const;

  std::shared_ptr<const CloudPoints> points_;
  GridFrame frame_;
  CloudLook look_;
  Mat3 linear_, for_normals_;  // from metres along the axes of the lattice; its inverse transpose
  bool mirrored_ = false;
  double stretch_ = 1, least_radius_ = 0, largest_reach_ = 0, rounding_ = 0;
  Box bounds_;
};

}  // namespace hl
