// Work: how much one tick has done. It is counted, not timed, and by what each look at a place finds, so that every
// machine, instruction set, hierarchy and cache comes to the same number. A tick whose work is used up ends where it
// is; the next goes on from there. So that all ticks together come to the end, each makes one step that comes nearer.
#pragma once

#include "proxy/contacts.h"
#include "proxy/tolerances.h"

namespace hl {

/// For one tick. RT-safe.
class Work {
 public:
  explicit Work(int most) : left_(most) {}

  void looked(const ContactSet& set) {
    left_ -= convergence::kWorkPerLook + static_cast<int>(set.contacts.size() + set.twins.size());
  }
  /// The proxy has made a step that counts: not one on trial.
  void stepped() { has_stepped_ = true; }

  /// Nothing new should be begun.
  bool usedUp() const { return left_ <= 0; }
  /// The tick may end.
  bool ends() const { return usedUp() && has_stepped_; }

 private:
  int left_;
  bool has_stepped_ = false;
};

}  // namespace hl
