// How long something takes, asked many times: every tick and every question counts, none is dropped.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// The same ticks or questions, one after the other, so many times. What the machine does beside them, some 20 us for
/// each tick of its own clock, hits one of three seldom and two hardly ever.
inline constexpr int kPasses = 3;

class PassTimes {
 public:
  /// The next time of a pass; each pass has the same number, in the same order.
  void add(int pass, std::int64_t time_ns) { passes_[static_cast<std::size_t>(pass)].push_back(time_ns); }
  /// Of each tick or question the middle one of its times.
  Timing middle() const;
  /// All times of all passes, with whatever else the machine did.
  Timing all() const;

 private:
  std::array<std::vector<std::int64_t>, kPasses> passes_;
};

struct TickTimes {
  PassTimes times;
  std::size_t capped = 0;       ///< ticks that the iteration cap ended
  std::size_t out_of_work = 0;  ///< ticks that ended as they had done all that one may
};

/// Moves a proxy along the path kPasses times, and times the ticks after its approach, at most `most` of them.
TickTimes timeTicks(const Snapshot& snapshot, const ProxySettings& settings, const Path& path, std::size_t most);

}  // namespace hl::bench
