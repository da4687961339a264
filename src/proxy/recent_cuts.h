// RecentCuts: primitives that were active in the last step and no longer touch the proxy. A sphere that rolls over an
// edge leaves it by the square of the step; on its way to the goal it would meet the same edge again a nanometre
// farther. Between two edges it would alternate, as alternating projections do. So the planes of these primitives count
// for one more step, with the place of the proxy now.
//
// This is sound because obstacles are convex: a step above such a plane does not meet the obstacle, and the proxy lies
// above the plane, so the step ends no farther from the goal. Whether the proxy rests depends only on what touches it.
#pragma once

#include "base/fixed_vector.h"
#include "proxy/contacts.h"
#include "proxy/solver.h"
#include "proxy/tolerances.h"

namespace hl {

/// For one tick. RT-safe.
class RecentCuts {
 public:
  using Planes = FixedVector<Plane, convergence::kMaxPlanesWithCuts>;

  /// `set`: the contacts where the proxy is now. Primitives added by addActive() since the last call that are not among
  /// them become cuts; earlier cuts are dropped.
  void update(const ContactSet& set);
  bool empty() const { return left_.empty(); }

  /// Adds the planes of the cuts to `planes`, relative to the proxy at `position`: each keeps it `reach` (m) away.
  /// Returns how many; a primitive farther than kCutNear is no cut any more.
  std::size_t addPlanes(const SceneAt& scene, const Vec3& position, double reach, Planes& planes) const;

  /// The plane of this primitive is active in the next step; or those of all cuts are.
  void addActive(PrimitiveId primitive) { active_.push(primitive); }
  void keepActive();

 private:
  static constexpr std::size_t kRoom = 6;  // three planes determine a step, twice

  FixedVector<PrimitiveId, kRoom> active_, left_;
};

}  // namespace hl
