// Trial: a watchdog line search (Chamberlain, Powell, Lemarechal and Pedersen 1982). A second-order step leaves the
// surface for a moment and may end farther from the goal; within some steps that come down from it the proxy must be
// nearer than where the trial began, else it goes back there. Steps that pay off become bolder; those that do not are
// tried ever less often, unless they would go much farther than plain ones.
//
// Invariant: after a trial has ended the proxy is nearer to the goal than where it began, or there.
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
  /// Counts one try of a step so many times as long as the plain one; false where it is to be left out. One that is
  /// much longer never is: plain steps would get nowhere meanwhile.
  bool mayBegin(double per_plain) { return !open() && (back_off_.mayTry() || per_plain >= convergence::kMuchLonger); }
  /// Of the next step: 1, or less where such steps have not paid off.
  double boldness() const { return boldness_; }

  void begin(const Vec3& checkpoint);
  /// The proxy has made one step that comes down.
  void descended() { ++descents_; }
  /// Where a trial is open, to be asked after each step that comes down. `step_m`: the length of the next; `last`:
  /// there is none. Returns whether the proxy has been put back.
  bool judge(const Goal& goal, double step_m, bool last, Vec3& position);
  /// The same when the tick ends.
  bool conclude(const Goal& goal, Vec3& position);

 private:
  bool hopeless(const Goal& goal, double step_m, const Vec3& position) const;

  std::optional<Vec3> checkpoint_;  // of the open trial
  int descents_ = 0;                // steps since
  double boldness_ = 1;
  BackOff back_off_;
};

}  // namespace hl
