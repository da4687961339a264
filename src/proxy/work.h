// Work: the cost of one tick. It is counted, not timed, so that it is the same on every machine and instruction set.
// Unit: one bounding volume visited, about 5 ns. A tick that reaches its limit ends where it is, and the next tick
// continues from there. Each tick makes at least one step that comes nearer, so that the proxy arrives in the end.
//
// Different hierarchies, or different contents of the caches, need different work for the same answer. They may only
// change where a tick ends that reaches its limit. A recorded tick is replayed by the number of looks after which the
// limit was reached, whatever these looks cost in the replay. A look is one gathering of contacts at a position.
#pragma once

#include <cstddef>

#include "proxy/contacts.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// For one tick. RT-safe.
class Work {
 public:
  /// Limits: `most` volumes and `most_looks` looks. `scene`, which counts the cost of its queries, must outlive this
  /// object.
  Work(const SceneAt& scene, std::size_t most, int most_looks) : scene_(scene), most_(most), most_looks_(most_looks) {}

  /// Counts one look, which includes the step that follows.
  void looked(const ContactSet& set) {
    done_ += convergence::kWorkPerLook + convergence::kWorkPerContact * (set.contacts.size() + set.twins.size());
    ++looks_;
    if (used_up_at_ == 0 && (done() >= most_ || looks_ >= most_looks_)) used_up_at_ = looks_;
  }
  /// Records a step that counts: any plain step outside a trial, or an accepted trial.
  void stepped() { has_stepped_ = true; }

  /// Work so far, in bounding volumes.
  std::size_t done() const {
    const QueryCost& cost = scene_.cost();
    return done_ + cost.volumes + convergence::kWorkPerPrimitive * cost.primitives;
  }
  int looks() const { return looks_; }
  /// Number of looks after which the limit was reached; 0: not reached.
  int usedUpAt() const { return used_up_at_; }
  /// Whether the limit is reached: no new trial should begin.
  bool usedUp() const { return used_up_at_ > 0; }
  /// Whether the tick may end: the limit is reached and a step that counts has been made.
  bool ends() const { return usedUp() && has_stepped_; }

 private:
  const SceneAt& scene_;
  const std::size_t most_;
  const int most_looks_;
  std::size_t done_ = 0;
  int looks_ = 0, used_up_at_ = 0;
  bool has_stepped_ = false;
};

}  // namespace hl
