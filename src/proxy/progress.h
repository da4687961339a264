// Progress: two ways in which a tick ends although its next step is not zero:
//   stalled   the steps come no nearer to the goal and are so short that rounding decides them. The crossing of planes
//             that nearly face each other is decided by rounding; the proxy would move among a few places for ever.
//   settled   the passes over the surfaces' rules have converged, on faces that still touch the proxy: another search
//             would find the same.
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
  /// For a new goal: forgets the progress toward the old one.
  void begin() { *this = {}; }
  /// After each step. Returns whether the last steps have come no nearer: if this one is so short that rounding may
  /// have decided it, the tick has stalled.
  bool idleAt(const Vec3& position, const Goal& goal);
  void stall() { stalled_ = true; }
  bool stalled() const { return stalled_; }

  /// The passes have converged on these contacts.
  void settleOn(const ContactSet& set);
  void unsettle() { settled_on_.clear(); }
  bool settledOn(const ContactSet& set) const { return !settled_on_.empty() && sameFaces(set); }

 private:
  bool sameFaces(const ContactSet& set) const;

  std::optional<Vec3> nearest_;  // where steps have come nearest to the goal
  int idle_ = 0;                 // steps in a row that have not come nearer
  bool stalled_ = false;
  FixedVector<PrimitiveId, convergence::kFewContacts> settled_on_;  // faces; empty while the passes go on
};

}  // namespace hl
