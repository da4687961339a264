// Step work: how much the search for the impulses of a step may still do, so that a step has an end whatever touches.
#pragma once

namespace hl {

/// Counted in updates of a row by a sweep, of some 0.04 us: a millisecond in all.
class StepWork {
 public:
  static constexpr int kMax = 25'000;

  void begin() { left_ = kMax; }
  void spend(int updates) { left_ -= updates; }
  int left() const { return left_ > 0 ? left_ : 0; }

 private:
  int left_ = kMax;
};

}  // namespace hl
