// Constraints: the contacts at the proxy's position, and the step that they allow. Each obstacle is convex, so the
// half-space above its tangent plane in configuration space is free of it. The step solves the convex subproblem
//
//   min |x - goal|   above the plane of each contact, and of each recent cut (recent_cuts.h)
//
// Invariant: at the end of a proposed step, and everywhere on it, the proxy is `reach` away from all current contacts,
// to within Tolerances::feasible. The step ends no farther from the goal.
#pragma once

#include <optional>

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

  /// Gathers the contacts at `position`. `toward`: the vector to the goal; it decides which contacts are kept if there
  /// are too many.
  void gather(const Vec3& position, const Vec3& toward, SweepCache& cache);
  const ContactSet& set() const { return set_; }
  bool touches() const { return !set_.contacts.empty(); }

  /// Proposes the step toward a goal at the offset `gap`, above the planes of the contacts.
  void nearestTo(const Vec3& gap, Proposal& proposal);
  /// Replaces the step by one that is also above the recent cuts, if any of them is active. Without contacts only a
  /// step of up to kMaxCutPerSlid times `slid_m` is taken. `slid_m`: the way slid since the last contact.
  void addCuts(const Vec3& position, const Vec3& gap, double slid_m, Proposal& proposal);
  /// Resets the count of consecutive steps with cuts.
  void leaveCutsOut() { cuts_in_a_row_ = 0; }
  /// Solver result of the last nearestTo().
  const SolverResult& solved() const { return solved_; }

  /// Updates the contacts for a proxy that has moved by `step`, when every contact has stayed on its face.
  void moveBy(const Vec3& step) { moveContacts(set_, step); }

 private:
  bool strays(const Vec3& gap) const;
  std::optional<Vec3> stepAboveCuts(const Vec3& position, const Vec3& gap, double slid_m);

  const TickInput& input_;
  ContactSet set_;
  SolverResult solved_;
  RecentCuts cuts_;
  int cuts_in_a_row_ = 0;  // consecutive steps with active cuts
};

}  // namespace hl
