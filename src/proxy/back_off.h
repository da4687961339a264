// BackOff: when to try again what has failed. After the n-th failure the next 2^n tries are left out, 1024 at most:
// what never works costs next to nothing.
#pragma once

#include <algorithm>

#include "proxy/tolerances.h"

namespace hl {

/// Plain values; RT-safe.
class BackOff {
 public:
  /// Counts one try; false where it is to be left out.
  bool mayTry() {
    if (left_out_ == 0) return true;
    --left_out_;
    return false;
  }
  void failed() {
    failures_ = std::min(failures_ + 1, convergence::kMaxFailures);
    left_out_ = 1 << failures_;
  }
  /// Failures count anew. Who never says so tries ever less often.
  void worked() { failures_ = 0; }

 private:
  int failures_ = 0, left_out_ = 0;
};

}  // namespace hl
