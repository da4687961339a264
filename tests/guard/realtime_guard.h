// RealtimeGuard: a guard for tests of what the real-time loops call. While it lives, the first call of this thread to
// the heap, to a lock that can wait, or to throw prints what it was and aborts. System calls: guard/system_call_trap.h.
// Works only in programs that link the object library hl_realtime_guard, which puts itself before these functions of
// the C and C++ libraries. The sanitizers do so themselves: in their builds only operator new and delete are guarded.
#pragma once

#include <cstdint>

namespace hl {

class RealtimeGuard {
 public:
#ifdef HL_SANITIZED
  static constexpr bool kWhole = false;
#else
  static constexpr bool kWhole = true;  ///< malloc and its like, locks and exceptions are guarded too
#endif

  RealtimeGuard();
  ~RealtimeGuard();
  RealtimeGuard(const RealtimeGuard&) = delete;
  RealtimeGuard& operator=(const RealtimeGuard&) = delete;

  /// Heap calls by this thread so far, guarded or not: proves in a test that the guard is linked.
  static std::uint64_t heapCalls();

  /// For what stands before a function of the C library: counts it, and aborts where it must not be called.
  static void onHeapCall();
  static void onCall(const char* what);
};

}  // namespace hl
