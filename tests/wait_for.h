// For tests beside threads and processes: they wait for what these do, never for a time.
#pragma once

#include <chrono>
#include <thread>

namespace hl::test {

/// Returns when `condition` holds; looks a thousand times a second. One that never holds is found by ctest's timeout.
template <typename Condition>
void waitFor(const Condition& condition) {
  while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace hl::test
