#include "proxy/far_goal.h"

#include <algorithm>
#include <cmath>

namespace hl {

// Computed about the point of the way nearest to the centre, which is accurate to the rounding error of the start of
// the way.
FarGoal::Within FarGoal::within(const Vec3& from, const Vec3& way) const {
  const double radius = 0.5 * farthest_m_;
  const bool inside = from.squaredNorm() <= radius * radius;
  const double a = way.squaredNorm();
  if (!(a > 0)) return inside ? Within{} : Within{1, 0};
  const double middle = -from.dot(way) / a;
  const double half2 = (radius * radius - (from + middle * way).squaredNorm()) / a;
  if (!inside && (half2 < 0 || middle < 0)) return {1, 0};
  const double half = std::sqrt(std::max(0.0, half2));
  return {inside ? 0 : std::max(0.0, middle - half), std::min(middle + half, 1.0)};
}

}  // namespace hl
