// RecentCuts: primitives that were active in the last step and are no longer contacts. A sphere that rolls over an edge
// leaves it by a distance of second order in the step. A straight step toward the goal would meet the same edge again a
// nanometre farther. Between two edges the proxy would alternate, as alternating projections do. So the planes of these
// primitives stay constraints (cuts) for one more step, computed anew at the proxy's position.
//
// This is sound because obstacles are convex: a step above such a plane does not meet its obstacle. The proxy itself is
// above the plane, so the step ends no farther from the goal. Whether the proxy is at rest is decided by the contacts
// alone.
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

  /// To be called with the contacts at the new position. The primitives given to addActive() since the last call that
  /// are not in `set` become the cuts. Older cuts are dropped.
  void update(const ContactSet& set);
  bool empty() const { return left_.empty(); }

  /// Appends to `planes` those of the cuts, relative to `position`, that keep the proxy `reach` (m) away. Cuts farther
  /// than kCutNear reaches are skipped. Returns the number added.
  std::size_t addPlanes(const SceneAt& scene, const Vec3& position, double reach, Planes& planes) const;

  /// Records that `primitive` is active in the next step; keepActive() records this of all cuts.
  void addActive(PrimitiveId primitive) { active_.push(primitive); }
  void keepActive();

 private:
  static constexpr std::size_t kRoom = 2 * kMaxActive;  // of two steps

  FixedVector<PrimitiveId, kRoom> active_, left_;
};

}  // namespace hl
