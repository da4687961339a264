// Box: an axis-aligned box.
#pragma once

#include "base/vec.h"

namespace hl {

/// Empty if min > max on any axis.
struct Box {
  Vec3 min = Vec3::Constant(1e300);
  Vec3 max = Vec3::Constant(-1e300);
  void extend(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  void extend(const Box& box) {
    min = min.cwiseMin(box.min);
    max = max.cwiseMax(box.max);
  }
  bool empty() const { return (min.array() > max.array()).any(); }
  /// Whether the boxes have a common point; an empty box has none.
  bool meets(const Box& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  bool contains(const Box& other) const {
    return (min.array() <= other.min.array()).all() && (max.array() >= other.max.array()).all();
  }
  Vec3 centre() const { return 0.5 * (min + max); }
  Vec3 size() const { return max - min; }
};

}  // namespace hl
