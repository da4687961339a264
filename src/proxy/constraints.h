// Constraints: the primitives that touch the proxy, and the step that they allow. Each obstacle is convex, so the
// half-space above its tangent plane in configuration space is free of it. The step solves the convex subproblem:
//
//   min |x - goal|   above the plane of each contact, and of each recent cut (recent_cuts.h)
//
// Invariant: a proposed step, and each part of it, keeps the proxy `reach` away from all contacts, to within
// Tolerances::feasible; and it ends no farther from the goal.
#pragma once

#include "base/vec.h"
#include "proxy/contacts.h"
#include "proxy/proposal.h"
#include "proxy/recent_cuts.h"
#include "proxy/solver.h"
#include "proxy/tick_input.h"

namespace hl {

/// For one tick. World frame. RT-safe.
class Constraints {
 public:
  explicit Constraints(const TickInput& input) : input_(input) {}

  /// Finds the contacts of the proxy at `position`; `toward` is the way that it wants to go.
  void gather(const Vec3& position, const Vec3& toward, SweepCache& cache);
  const ContactSet& set() const { return set_; }
  bool touches() const { return !set_.contacts.empty(); }

  /// Proposes the step toward a goal `gap` away, by the planes of the contacts.
  void nearestTo(const Vec3& gap, Proposal& proposal);
  /// The same by the recent cuts too, where they count: in the open only for steps up to some times `slid_m`, the way
  /// slid since the last touch.
  void addCuts(const Vec3& position, const Vec3& gap, double slid_m, Proposal& proposal);
  /// Cuts have not been asked for this time.
  void leaveCutsOut() { cuts_in_a_row_ = 0; }
  /// What nearestTo() has solved last.
  const SolverResult& solved() const { return solved_; }

  /// The proxy has moved by `step` and every contact has stayed on its face.
  void moveBy(const Vec3& step) { moveContacts(set_, step); }

 private:
  bool strays(const Vec3& gap) const;
  bool solveWithCuts(const Vec3& position, const Vec3& gap, double slid_m, Vec3& step);

  const TickInput& input_;
  ContactSet set_;
  SolverResult solved_;
  RecentCuts cuts_;
  int cuts_in_a_row_ = 0;  // steps
};

}  // namespace hl
