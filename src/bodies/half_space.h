// HalfSpace: all that is at or above a plane, or, for a hull, beneath it.
#pragma once

#include "base/vec.h"

namespace hl {

struct HalfSpace {
  Vec3 normal;        ///< unit
  double offset = 0;  ///< m, of the plane from the origin along the normal
  double above(const Vec3& point) const { return normal.dot(point) - offset; }
  HalfSpace turned() const { return {-normal, -offset}; }
};

}  // namespace hl
