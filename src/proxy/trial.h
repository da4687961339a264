// Trial: a watchdog line search (Chamberlain, Powell, Lemarechal and Pedersen 1982). A second-order step leaves the
// surface and may end farther from the goal. A few plain steps then bring the proxy back to the surface. If after these
// it is not nearer to the goal than at the start of the trial (the checkpoint), it returns to the checkpoint. After a
// success the next trial step is longer. After a failure it is shorter, and more tries are skipped unless the step
// would be much longer than a plain one.
//
// Invariant: when a trial has ended, the proxy is nearer to the goal than the checkpoint, or at the checkpoint.
#pragma once

#include <optional>

#include "base/vec.h"
#include "proxy/back_off.h"
#include "proxy/goal.h"
#include "proxy/tolerances.h"

namespace hl {

/// For one tick. World frame. RT-safe.
class Trial {
 public:
  bool open() const { return checkpoint_.has_value(); }
  /// Counts one try of a step that is `per_plain` times as long as the plain step. Returns false if it is to be
  /// skipped. A step that is much longer is never skipped, as plain steps would progress too slowly.
  bool mayBegin(double per_plain) { return !open() && (back_off_.mayTry() || per_plain >= convergence::kMuchLonger); }
  /// Fraction of the Newton step to use next: 1, or less after failures.
  double boldness() const { return boldness_; }

  void begin(const Vec3& checkpoint);
  /// Counts one plain step of the open trial.
  void descended() { ++descents_; }
  /// To be called after each plain step of an open trial. `step_m`: length of the next step. `last`: there is no next
  /// step. Returns whether `position` was reset to the checkpoint.
  bool judge(const Goal& goal, double step_m, bool last, Vec3& position);
  /// Ends the open trial at once, as judge() does. Returns whether `position` was reset to the checkpoint.
  bool conclude(const Goal& goal, Vec3& position);

 private:
  bool hopeless(const Goal& goal, double step_m, const Vec3& position) const;

  std::optional<Vec3> checkpoint_;  // start of the open trial
  int descents_ = 0;                // plain steps since the checkpoint
  double boldness_ = 1;
  BackOff back_off_;
};

}  // namespace hl
