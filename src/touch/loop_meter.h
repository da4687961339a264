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
  /// Work of one step that began at `now_ns`; returns true when a new summary is ready (once a second).
  bool add(std::int64_t now_ns, std::int64_t work_ns) {
    if (begin_ns_ == 0) begin_ns_ = now_ns;
    second_.add(static_cast<std::uint64_t>(work_ns < 0 ? 0 : work_ns));
    whole_.add(static_cast<std::uint64_t>(work_ns < 0 ? 0 : work_ns));
    const std::int64_t elapsed_ns = now_ns - begin_ns_;
    if (elapsed_ns < 1'000'000'000) return false;
    summary_ = {1e9 * static_cast<double>(second_.count()) / static_cast<double>(elapsed_ns),
                second_.percentile_ns(0.5), second_.percentile_ns(0.999), second_.max_ns()};
    second_.clear();
    begin_ns_ = now_ns;
    return true;
  }
  const LoopSummary& summary() const { return summary_; }
  /// Since the start; read it when the loop has ended.
  const Histogram& whole() const { return whole_; }

 private:
  Histogram second_;
  Histogram whole_;
  LoopSummary summary_;
  std::int64_t begin_ns_ = 0;
};

}  // namespace hl
