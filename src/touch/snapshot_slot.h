// SnapshotSlot: how a new scene reaches a real-time loop. The loop takes a pointer and never frees anything; the
// publisher frees a scene when the loop has moved on to the next, or has never taken it.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "scene/snapshot.h"

namespace hl {

/// One publisher (any one thread at a time, not real-time) and one reader.
class SnapshotSlot {
 public:
  explicit SnapshotSlot(std::shared_ptr<const Snapshot> first) : newest_(first), current_(first.get()) {
    in_use_ = std::move(first);
  }

  /// Whether the reader has taken the newest one.
  bool taken() const { return waiting_.load(std::memory_order_acquire) == nullptr; }
  /// One that the reader has not taken by then it never will.
  void publish(std::shared_ptr<const Snapshot> next) {
    // The reader has begun to use the newest one, and so ended with the one before, if it no longer waits.
    const bool taken = waiting_.exchange(next.get(), std::memory_order_acq_rel) == nullptr;
    if (taken) in_use_ = std::move(newest_);
    newest_ = std::move(next);
  }
  /// Frees the one before, unless the reader may still be in it. Publisher.
  void dropBefore() {
    if (taken()) in_use_.reset();
  }
  /// The newest that was published. Publisher.
  const std::shared_ptr<const Snapshot>& newest() const { return newest_; }

  /// The newest one; valid until the next call. Reader; RT-safe.
  const Snapshot& take() {
    if (waiting_.load(std::memory_order_relaxed) == nullptr) return *current_;
    // Only the reader takes away, so there still is one, perhaps a newer.
    current_ = waiting_.exchange(nullptr, std::memory_order_acq_rel);
    return *current_;
  }

 private:
  std::shared_ptr<const Snapshot> newest_;         // of the publisher, as the next
  std::shared_ptr<const Snapshot> in_use_;         // the reader may be in this one, or in the newest
  std::atomic<const Snapshot*> waiting_{nullptr};  // published and not taken
  const Snapshot* current_;                        // of the reader
};

}  // namespace hl
