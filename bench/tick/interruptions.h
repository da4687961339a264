// Interruptions: how often, and for how long, this machine takes the processor away from a thread that does nothing but
// read the clock. The longest ones of so many single times can be no shorter.
#pragma once

#include <cstdint>

#include "tick/timing.h"

namespace hl::bench {

struct Interruptions {
  Timing gaps;         ///< between readings of the clock, where they are longer than kMinGap_ns
  double seconds = 0;  ///< that were looked at
};
/// Reading the clock takes some 20 ns, and a step out of the caches less than this.
inline constexpr std::int64_t kMinGap_ns = 2000;

/// Reads the clock for so long, s.
Interruptions measureInterruptions(double seconds);

}  // namespace hl::bench
