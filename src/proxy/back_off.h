// BackOff: exponential back-off. After the n-th failure in a row the next 2^n tries are skipped, 1024 at most, so a
// method that never works costs almost nothing.
#pragma once

#include <algorithm>

#include "proxy/tolerances.h"

namespace hl {

/// Plain values; RT-safe.
class BackOff {
 public:
  /// Counts one try; false: skip it.
  bool mayTry() {
    if (left_out_ == 0) return true;
    --left_out_;
    return false;
  }
  void failed() {
    failures_ = std::min(failures_ + 1, convergence::kMaxFailures);
    left_out_ = 1 << failures_;
  }
  /// Resets the count of failures.
  void worked() { failures_ = 0; }

 private:
  int failures_ = 0, left_out_ = 0;
};

}  // namespace hl
