// FailingAllocation: for tests of what a failed allocation costs. In programs that link hl_realtime_guard one C++
// allocation of a named thread fails: operator new and Boost.Asio's aligned_alloc.
#pragma once

#include <cstdint>

namespace hl {

class FailingAllocation {
 public:
  /// From now on the `nth` allocation (from 1) of the threads named `thread` (guarded_thread.h) fails, and no other.
  static void arm(const char* thread, std::int64_t nth);
  /// No more; whether it had failed.
  static bool disarm();
  static bool hasFailed();

  /// Asked by each allocation.
  static bool isNow() noexcept;
};

}  // namespace hl
