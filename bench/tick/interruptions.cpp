#include "tick/interruptions.h"

#include "base/clock.h"

namespace hl::bench {

Interruptions measureInterruptions(double seconds) {
  Interruptions result;
  result.seconds = seconds;
  const std::int64_t start_ns = monotonicNow_ns();
  const std::int64_t end_ns = start_ns + static_cast<std::int64_t>(1e9 * seconds);
  for (std::int64_t last_ns = start_ns; last_ns < end_ns;) {
    const std::int64_t now_ns = monotonicNow_ns();
    if (now_ns - last_ns >= kMinGap_ns) result.gaps.add(now_ns - last_ns);
    last_ns = now_ns;
  }
  return result;
}

}  // namespace hl::bench
