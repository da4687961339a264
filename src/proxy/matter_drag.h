// Matter drag: matter that hinders the proxy's motion, as tissue does a needle's. It is friction without a surface
// (K. Lundin, A. Ynnerman, B. Gudmundsson, Proxy-based haptic feedback from volumetric density data, 2002):
//
//   x' = x + max(0, |p| - F) / (K s + b / T) p / |p|,   p = K s (finger - x)
//
// with the resistance F and the drag b of the matter at x. At a steady speed v the spring pulls with F + b v. The proxy
// goes there as it goes to a finger: past surfaces, and held by them. Its spring only loses energy.
//
// With F = 0 this place g is where K s (finger - x') = b (x' - x) / T, the least of K s |finger - x'|^2 + b / T |x' -
// x|^2: a spring of K s + b / T toward g. So a contact that keeps the proxy from g is pressed by (K s + b / T) lambda,
// and the matter has what is left of the pull: nothing, if the proxy does not move.
//
// s is that of the surface which the proxy touched last, for as long as the matter holds it there. Where the proxy
// moves on without a surface, the spring is K again: the proxy goes on to where that pulls as hard, finger + s (x -
// finger).
#pragma once

#include "geometry/matter_force.h"
#include "proxy/goal_tick.h"
#include "proxy/proxy_state.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"

namespace hl {

/// What hinders the proxy where it is: of several objects the largest of each number. RT-safe.
MatterForce matterAround(const SceneAt& scene, const Vec3& position);

/// A tick of a proxy within such matter. RT-safe.
TickReport tickInMatter(ProxyState& state, const ProxySettings& settings, const MatterForce& matter, const Vec3& finger,
                        TickTo tick_to);

}  // namespace hl
