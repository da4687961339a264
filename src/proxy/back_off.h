// BackOff: after the n-th failure in a row, skips the next 2^n tries, at most 1024. A method that never works then
// costs almost nothing.
#pragma once

#include <algorithm>

#include "proxy/tolerances.h"

namespace hl {

/// Plain values; RT-safe.
class BackOff {
 public:
  /// Counts one try. Returns false if it is to be skipped.
  bool mayTry() {
    if (left_out_ == 0) return true;
    --left_out_;
    return false;
  }
  void failed() {
    failures_ = std::min(failures_ + 1, convergence::kMaxFailures);
    left_out_ = 1 << failures_;
  }
  /// Resets the number of failures. Must be called after a success, otherwise tries become ever rarer.
  void worked() { failures_ = 0; }

 private:
  int failures_ = 0, left_out_ = 0;
};

}  // namespace hl
