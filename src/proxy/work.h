// Work: how much one tick has done. It is counted, not timed, so that every machine and instruction set comes to the
// same number; its unit is a bounding volume looked at, some 5 ns. A tick whose work is used up ends where it is; the
// next goes on from there. So that all ticks together come to the end, each makes one step that comes nearer.
//
// Two hierarchies, and ticks that find other things in their caches, do different work for the same answer: they may
// differ in where a tick ends that is out of work, and in nothing else. A recorded tick is made again by the number of
// looks after which its work was used up, whatever they cost now.
#pragma once

#include <cstddef>

#include "proxy/contacts.h"
#include "proxy/tolerances.h"
#include "scene/scene_at.h"

namespace hl {

/// For one tick. RT-safe.
class Work {
 public:
  /// `most` volumes and `most_looks`. `scene`, which counts what it is asked, must outlive it.
  Work(const SceneAt& scene, std::size_t most, int most_looks) : scene_(scene), most_(most), most_looks_(most_looks) {}

  /// The proxy has looked at a place, which comes with a step.
  void looked(const ContactSet& set) {
    done_ += convergence::kWorkPerLook + convergence::kWorkPerContact * (set.contacts.size() + set.twins.size());
    ++looks_;
    if (used_up_at_ == 0 && (done() >= most_ || looks_ >= most_looks_)) used_up_at_ = looks_;
  }
  /// The proxy has made a step that counts: not one on trial, before that has paid off.
  void stepped() { has_stepped_ = true; }

  /// Volumes.
  std::size_t done() const {
    const QueryCost& cost = scene_.cost();
    return done_ + cost.volumes + convergence::kWorkPerPrimitive * cost.primitives;
  }
  int looks() const { return looks_; }
  /// Looks after which it was used up; 0: it is not.
  int usedUpAt() const { return used_up_at_; }
  /// Nothing new should be begun.
  bool usedUp() const { return used_up_at_ > 0; }
  /// The tick may end.
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
