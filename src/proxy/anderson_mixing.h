// AndersonMixing: Anderson's acceleration of a fixed-point iteration x -> next(x), here of the proxy's place in a
// sub-goal.
//
// With f = next(x) - x of the last three passes, f0 the newest, it takes the combination
//   g1, g2 = argmin |f0 - g1 (f0 - f1) - g2 (f1 - f2)|,   x = next0 - g1 (next0 - next1) - g2 (next1 - next2),
// which is the secant method in two dimensions, those of a tangent plane: the digits grow by more each pass, where with
// one difference alone (g2 = 0) each pass adds as many as the last.
#pragma once

#include "base/vec.h"

namespace hl {

/// RT-safe.
class AndersonMixing {
 public:
  /// Where to look next, after `next` came out `change` away from where it was looked.
  Vec3 guess(const Vec3& next, const Vec3& change);

 private:
  Vec3 mixed(const Vec3& next, const Vec3& change) const;

  int passes_ = 0;
  Vec3 last_next_ = Vec3::Zero(), last_change_ = Vec3::Zero();    // one pass before
  Vec3 older_next_ = Vec3::Zero(), older_change_ = Vec3::Zero();  // two passes before
};

}  // namespace hl
