// SnapshotSlot: how a new scene reaches a real-time loop, with the world of its bodies. The loop takes a pointer and
// never frees anything; the publisher frees a scene when the loop has moved on to the next, or has never taken it.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "scene/snapshot.h"
#include "touch/body_world.h"

namespace hl {

/// One publisher (any one thread at a time, not real-time) and one reader.
class SnapshotSlot {
 public:
  /// As publish().
  explicit SnapshotSlot(std::shared_ptr<const Snapshot> first) : current_(add(std::move(first))), oldest_(current_) {}

  /// Whether the reader has taken the newest one, and needs none before it.
  bool taken() const {
    return waiting_.load(std::memory_order_acquire) == nullptr &&
           oldest_.load(std::memory_order_acquire) == scenes_.back().get();
  }
  /// One that the reader has not taken by then it never will. Throws hl::Error where bodies cannot be made.
  void publish(std::shared_ptr<const Snapshot> next) {
    Scene* const scene = add(std::move(next));
    const Scene* const untaken = waiting_.exchange(scene, std::memory_order_acq_rel);
    if (untaken != nullptr) std::erase_if(scenes_, [&](const auto& one) { return one.get() == untaken; });
  }
  /// Frees those that the reader needs no more. Publisher.
  void dropBefore() {
    const Scene* const oldest = oldest_.load(std::memory_order_acquire);
    const auto first =
        std::find_if(scenes_.begin(), scenes_.end(), [&](const auto& one) { return one.get() == oldest; });
    scenes_.erase(scenes_.begin(), first);
  }
  /// The newest that was published. Publisher.
  const std::shared_ptr<const Snapshot>& newest() const { return scenes_.back()->snapshot; }

  /// The newest one; valid until the call after the next. Its bodies go on from where those of the scene before are.
  /// Reader; RT-safe.
  const Snapshot& take() {
    oldest_.store(current_, std::memory_order_release);
    if (waiting_.load(std::memory_order_relaxed) == nullptr) return *current_->snapshot;
    // Only the reader takes away, so there still is one, perhaps a newer.
    Scene* const next = waiting_.exchange(nullptr, std::memory_order_acq_rel);
    if (next->bodies && current_->bodies) next->bodies->continueFrom(*current_->bodies);
    current_ = next;
    return *current_->snapshot;
  }
  /// Of the scene that was taken; null: it has none. Reader; RT-safe.
  BodyWorld* bodies() const { return current_->bodies.get(); }

 private:
  struct Scene {
    std::shared_ptr<const Snapshot> snapshot;
    std::unique_ptr<BodyWorld> bodies;
  };
  Scene* add(std::shared_ptr<const Snapshot> snapshot) {
    auto bodies = BodyWorld::of(*snapshot);
    scenes_.push_back(std::make_unique<Scene>(Scene{std::move(snapshot), std::move(bodies)}));
    return scenes_.back().get();
  }

  std::vector<std::unique_ptr<Scene>> scenes_;  // of the publisher: all that the reader may be in, the newest last
  std::atomic<Scene*> waiting_{nullptr};        // published and not taken
  Scene* current_;                              // of the reader
  std::atomic<const Scene*> oldest_;            // the reader needs none before it
};

}  // namespace hl
