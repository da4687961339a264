// Progress: when the steps of a tick have come to an end other than by a step of no length:
//   stalled   steps come no nearer to the goal, and are as short as those of planes that lean by the skin: rounding
//             leads them. Planes that all but face each other cross where rounding says; there the proxy would go to
//             and fro among a few places for ever.
//   settled   the passes over the surfaces' rules have come to rest, on faces that still hold the proxy: another look
//             would find what the last pass found.
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
  /// The goal is another one: how near steps have come to the one before says nothing of it.
  void begin() { *this = {}; }
  /// The proxy has come there by a step. Returns whether steps come no nearer: where this one is so short that rounding
  /// may have led it, they have stalled.
  bool idleAt(const Vec3& position, const Goal& goal);
  void stall() { stalled_ = true; }
  bool stalled() const { return stalled_; }

  /// The passes have come to rest on these.
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
