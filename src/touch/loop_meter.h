// LoopMeter: what one real-time loop did in the last second: its rate and the tail of its work time.
#pragma once

#include <cstdint>

#include "base/histogram.h"

namespace hl {

struct LoopSummary {
  double rate_Hz = 0;
  std::uint64_t p50_ns = 0;
  std::uint64_t p999_ns = 0;
  std::uint64_t max_ns = 0;
};

/// Owned by the loop. RT-safe.
class LoopMeter {
 public:
  /// Of one step: when it began and how long it worked. Once a second it makes the summary anew.
  void add(std::int64_t now_ns, std::int64_t work_ns) {
    if (begin_ns_ == 0) begin_ns_ = now_ns;
    second_.add(static_cast<std::uint64_t>(work_ns < 0 ? 0 : work_ns));
    const std::int64_t elapsed_ns = now_ns - begin_ns_;
    if (elapsed_ns < 1'000'000'000) return;
    summary_ = {1e9 * static_cast<double>(second_.count()) / static_cast<double>(elapsed_ns),
                second_.percentile_ns(0.5), second_.percentile_ns(0.999), second_.max_ns()};
    second_.clear();
    begin_ns_ = now_ns;
  }
  const LoopSummary& summary() const { return summary_; }

 private:
  Histogram second_;
  LoopSummary summary_;
  std::int64_t begin_ns_ = 0;
};

}  // namespace hl
