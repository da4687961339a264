// How long something takes, asked many times: every time counts, none is dropped.
#pragma once

#include <cstdint>

#include "base/histogram.h"
#include "proxy/proxy.h"
#include "tick/finger_motion.h"

namespace hl::bench {

class Timing {
 public:
  void add(std::int64_t time_ns) {
    times_.add(static_cast<std::uint64_t>(time_ns));
    total_ns_ += time_ns;
  }
  std::uint64_t count() const { return times_.count(); }
  std::int64_t total_ns() const { return total_ns_; }
  double percentile_us(double fraction) const { return 1e-3 * static_cast<double>(times_.percentile_ns(fraction)); }
  double median_us() const { return percentile_us(0.5); }
  double max_us() const { return 1e-3 * static_cast<double>(times_.max_ns()); }
  double mean_us() const { return 1e-3 * static_cast<double>(total_ns_) / static_cast<double>(times_.count()); }

 private:
  Histogram times_;
  std::int64_t total_ns_ = 0;
};

struct TickTimes {
  Timing times;
  std::size_t capped = 0;  ///< ticks that the iteration cap ended
};

/// Moves a proxy along the path, and times the ticks after its approach, at most `most` of them.
TickTimes timeTicks(const Snapshot& snapshot, const ProxySettings& settings, const Path& path, std::size_t most);

}  // namespace hl::bench
