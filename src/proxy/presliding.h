// Pre-sliding: a proxy that friction holds moves on springs between it and the surface, as asperities do (elastoplastic
// friction: Dahl 1968; Hayward and Armstrong 2000). While the springs pull with less than friction carries, the proxy
// creeps on them, forth and back. Beyond that it slips, and they keep the pull that friction carries: when the slip
// ends or turns, the pull falls from there without a jump.
// What they store they give back, no more: the energy of the servo's spring and theirs together never rises by them.
#pragma once

#include "base/vec.h"

namespace hl {

struct PreslidingSprings {
  Vec3 stretch_m = Vec3::Zero();  ///< world: from where they hold on to the surface, to the proxy
  double stiffness_N_m = 0;       ///< of all contacts together, at the hand

  /// J, at the hand.
  double energy_J(double world_per_device) const {
    if (!(stiffness_N_m > 0)) return 0;
    return 0.5 * stiffness_N_m * (stretch_m / world_per_device).squaredNorm();
  }
  /// Where contacts come or go. Stiffer springs keep the pull, softer ones the stretch: the energy never rises.
  PreslidingSprings on(double new_stiffness_N_m) const {
    const bool stiffer = new_stiffness_N_m > stiffness_N_m;
    return {stiffer ? Vec3(stiffness_N_m / new_stiffness_N_m * stretch_m) : stretch_m, new_stiffness_N_m};
  }
  /// After a creep of the proxy by `step`.
  PreslidingSprings crept(const Vec3& step) const { return {stretch_m + step, stiffness_N_m}; }
  /// After a slip by `step`: stretched to `carried_m` by the pull that friction carries, and no farther than the step
  /// can have stretched them.
  PreslidingSprings slipped(const Vec3& step, const Vec3& carried_m) const {
    return {limited(carried_m, (stretch_m + step).norm()), stiffness_N_m};
  }
};

}  // namespace hl
