// RecentCuts: what held the proxy in the last step and touches it no more. A sphere that rolls over an edge leaves it
// by the square of the step; straight on toward the goal it would meet the same edge again a nanometre farther. Between
// two edges it would go to and fro, from one to the other, as alternating projections do. So the planes of what was
// left count for one step more: where the obstacle is now, as seen from the proxy.
//
// That is sound, as obstacles are convex: no step above such a plane meets its obstacle, and the proxy itself lies
// above it, so the step ends no farther from the goal. Whether the proxy rests is told by what touches it alone.
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

  /// Tells the contacts where the proxy is now. What holds() has named since the last call and is not among them has
  /// been left; what was left before is forgotten.
  void look(const ContactSet& set);
  bool empty() const { return left_.empty(); }

  /// Adds to `planes`, relative to the proxy at `position`, those of what was left that keep it `reach` (m) away.
  /// Returns how many; what is farther than kCutNear no longer counts.
  std::size_t addPlanes(const SceneAt& scene, const Vec3& position, double reach, Planes& planes) const;

  /// The next step is held by this one; or by all that was left.
  void holds(PrimitiveId primitive) { holding_.push(primitive); }
  void holdsStill();

 private:
  static constexpr std::size_t kRoom = 6;  // three planes determine a step, twice

  FixedVector<PrimitiveId, kRoom> holding_, left_;
};

}  // namespace hl
