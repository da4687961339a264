// SnapshotSlot: how a new scene reaches a real-time loop. The loop takes a pointer and never frees anything; the
// publisher frees a scene when the loop has moved on to the next.
#pragma once

#include <atomic>
#include <memory>

#include "scene/snapshot.h"

namespace hl {

/// One publisher (any one thread at a time, not real-time) and one reader.
class SnapshotSlot {
 public:
  explicit SnapshotSlot(std::shared_ptr<const Snapshot> first) : current_(std::move(first)), newest_(current_.get()) {
    taken_ = newest_.load();
  }

  /// Whether the reader has taken the newest one; only then another may be published.
  bool taken() const { return taken_.load(std::memory_order_acquire) == newest_.load(std::memory_order_relaxed); }
  /// Call it only when taken(), or when there is no reader.
  void publish(std::shared_ptr<const Snapshot> next) {
    before_ = std::move(current_);
    current_ = std::move(next);
    newest_.store(current_.get(), std::memory_order_release);
  }
  /// Frees the one before, when the reader has done with it: taken(), and a step since. Publisher.
  void dropBefore() { before_.reset(); }
  /// The newest that was published. Publisher.
  const std::shared_ptr<const Snapshot>& newest() const { return current_; }

  /// The newest one; valid until the next call. Reader; RT-safe.
  const Snapshot& take() {
    const Snapshot* snapshot = newest_.load(std::memory_order_acquire);
    taken_.store(snapshot, std::memory_order_release);
    return *snapshot;
  }

 private:
  std::shared_ptr<const Snapshot> before_, current_;  // the reader may still be in the one before
  std::atomic<const Snapshot*> newest_;
  std::atomic<const Snapshot*> taken_{nullptr};
};

}  // namespace hl
