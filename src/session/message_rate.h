// MessageRate: a token bucket; so many messages a second, with bursts of one second's worth.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/clock.h"

namespace hl {

class MessageRate {
 public:
  explicit MessageRate(double rate_Hz) : rate_Hz_(rate_Hz), left_(rate_Hz) {}

  /// Counts one message at `now_ns` (never earlier than the time before); false when it comes too soon.
  bool allow(std::int64_t now_ns) {
    if (last_ns_ != 0) left_ = std::min(rate_Hz_, left_ + rate_Hz_ * seconds(now_ns - last_ns_));
    last_ns_ = now_ns;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double rate_Hz_;
  double left_;
  std::int64_t last_ns_ = 0;
};

}  // namespace hl
