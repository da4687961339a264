#include "touch/held_contacts.h"

#include <span>

namespace hl {

namespace {

// By which a plane may be violated: far below any encoder, far above the rounding of half a metre.
constexpr double kFeasible_m = 1e-12;

}  // namespace

ServoTarget HeldContacts::at(const Vec3& finger_D) const {
  ServoTarget now = target;
  if (planes_D.empty() || !target.valid || !finger_D.allFinite()) return now;
  const SolverResult nearest = nearestAbove({planes_D.begin(), planes_D.size()}, finger_D, kFeasible_m);
  if (nearest.violation <= kFeasible_m) now.proxy_D = nearest.point;
  return now;
}

}  // namespace hl
