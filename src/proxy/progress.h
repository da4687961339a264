// Progress: ends a tick whose steps do not shrink to zero.
//   stalled   steps come no nearer to the goal and are as short as steps between planes tilted by rounding within the
//             skin. Planes that almost face each other intersect at a point that rounding decides; the proxy would move
//             between a few positions for ever.
//   settled   the passes over the rules of the surfaces have converged, and the contacts are still the same faces:
//             gathering contacts again would give the same result.
#pragma once

#include <optional>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "proxy/contacts.h"
#include "proxy/goal.h"
#include "proxy/surface_rules.h"

namespace hl {

/// For one tick. World frame. RT-safe.
class Progress {
 public:
  /// To be called when the goal changes: the progress toward the old goal is no longer valid.
  void begin() { *this = {}; }
  /// Records that a step ended at `position`. Returns whether recent steps have come no nearer to the goal. The caller
  /// then checks whether the step is short enough to be caused by rounding.
  bool idleAt(const Vec3& position, const Goal& goal);
  void stall() { stalled_ = true; }
  bool stalled() const { return stalled_; }

  /// Records that the passes have converged on these contacts.
  void settleOn(const ContactSet& set);
  void unsettle() { settled_on_.clear(); }
  bool settledOn(const ContactSet& set) const { return !settled_on_.empty() && sameFaces(set); }

 private:
  bool sameFaces(const ContactSet& set) const;

  std::optional<Vec3> nearest_;  // the recorded position nearest to the goal
  int idle_ = 0;                 // consecutive steps that came no nearer
  bool stalled_ = false;
  FixedVector<PrimitiveId, convergence::kFewContacts> settled_on_;  // faces; empty while the passes have not converged
};

}  // namespace hl
