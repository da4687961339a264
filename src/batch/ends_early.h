// Ends a call of hl_batch.h that somebody waits for: Ctrl-C in Python must not wait for a million rows.
#pragma once

#include <atomic>

#include "base/error.h"

namespace hl {

/// While one exists, hlBatchTrace and hlBatchClosest that its thread calls end with an error soon after `stop` has
/// become true. What they have written by then is unfinished.
class EndsEarly {
 public:
  explicit EndsEarly(const std::atomic<bool>& stop) { of_this_thread = &stop; }
  EndsEarly(const EndsEarly&) = delete;
  EndsEarly& operator=(const EndsEarly&) = delete;
  ~EndsEarly() { of_this_thread = nullptr; }

  /// Of this thread; null: none.
  static const std::atomic<bool>* ofThisThread() { return of_this_thread; }

 private:
  inline static thread_local const std::atomic<bool>* of_this_thread = nullptr;
};

/// `stop`: null: never.
inline void throwIfStopped(const std::atomic<bool>* stop) {
  if (stop != nullptr && stop->load(std::memory_order_relaxed)) throw Error("the call was ended early");
}

}  // namespace hl
