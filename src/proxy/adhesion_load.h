// Adhesion loads: what a surface with adhesion presses on the proxy beyond what the goal of the tick does (adhesion.h).
// Friction counts it as normal force.
#pragma once

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "proxy/solver.h"

namespace hl {

struct AdhesionLoad {
  Vec3 normal;    ///< unit, of the contact
  double load_m;  ///< newtons over K s
};
using AdhesionLoads = FixedVector<AdhesionLoad, kMaxActive>;

}  // namespace hl
