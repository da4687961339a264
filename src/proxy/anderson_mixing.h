// AndersonMixing: Anderson's acceleration of a fixed-point iteration x -> next(x), here for the proxy's position in a
// sub-goal.
//
// With f = next(x) - x of the last three passes, f0 the newest, the result is
//   g1, g2 = argmin |f0 - g1 (f0 - f1) - g2 (f1 - f2)|,   x = next0 - g1 (next0 - next1) - g2 (next1 - next2).
// This is the secant method in two dimensions, those of a tangent plane: convergence is superlinear. With one
// difference alone (g2 = 0) it is linear.
#pragma once

#include "base/vec.h"

namespace hl {

/// RT-safe.
class AndersonMixing {
 public:
  /// Returns the next x, after next(x) = `next` with next(x) - x = `change`.
  Vec3 guess(const Vec3& next, const Vec3& change);

 private:
  Vec3 mixed(const Vec3& next, const Vec3& change) const;

  int passes_ = 0;
  Vec3 last_next_ = Vec3::Zero(), last_change_ = Vec3::Zero();    // one pass before
  Vec3 older_next_ = Vec3::Zero(), older_change_ = Vec3::Zero();  // two passes before
};

}  // namespace hl
