// Step work: how much the search for the impulses of a step may still do, so that a step has an end whatever touches.
#pragma once

#include <algorithm>

namespace hl {

/// Counted in updates of a row by a sweep, of some 0.04 us: a millisecond in all.
class StepWork {
 public:
  static constexpr int kMax = 25'000;

  void begin(int most = kMax) { left_ = most; }
  void spend(int updates) { left_ -= updates; }
  int left() const { return left_ > 0 ? left_ : 0; }
  /// Half of what is left, in sweeps of so many updates (>= 1), but at least `least`.
  int sweepsOf(int updates, int least) const {
    return std::clamp(left() / 2 / updates, least, std::max(least, kMaxSweeps));
  }

 private:
  static constexpr int kMaxSweeps = 1000;

  int left_ = kMax;
};

}  // namespace hl
