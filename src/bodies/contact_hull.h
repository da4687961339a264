// Contact hull: the corners of the contacts that two bodies have in one plane.
//
// What keeps the corners apart keeps all apart that lies between them. A contact there would be one of many ways to
// bear the same load, and the worst: a body that it bears alone, beneath its centre of mass, spins as on the tip of a
// needle, though it lies on a face.
#pragma once

#include <span>

#include "base/fixed_vector.h"
#include "base/vec.h"

namespace hl {

/// In the plane across the normal.
struct FlatContact {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m
  double gap = 0;                                ///< m
};

/// Plain values. RT-safe.
class ContactHull {
 public:
  /// Of the contacts those count as corners that lie farthest out in eight directions.
  explicit ContactHull(std::span<const FlatContact> contacts);
  std::size_t corners() const { return corners_.size(); }
  /// Whether the corners surround this one, and keep its gap too, within `slack_m`.
  bool keeps(const FlatContact& one, double slack_m) const;

 private:
  bool surround(const Eigen::Vector2d& at) const;

  FixedVector<FlatContact, 8> corners_;
};

}  // namespace hl
