// SnapshotSlot: how a new scene reaches a real-time loop, with the world of its bodies. The loop takes a pointer and
// never frees anything; the publisher frees a scene when the loop has moved on to the next, or has never taken it.
#pragma once

#include <atomic>
#include <list>
#include <memory>
#include <utility>

#include "scene/snapshot.h"
#include "touch/body_world.h"

namespace hl {

/// One publisher (any one thread at a time, not real-time) and one reader.
class SnapshotSlot {
 private:
  struct Scene {
    std::shared_ptr<const Snapshot> snapshot;
    std::unique_ptr<BodyWorld> bodies;
    bool has_bodies = false;  // here or elsewhere
  };

 public:
  /// A scene with all that publishing it needs.
  using Ready = std::list<Scene>;

  /// Whose loop moves the bodies of a scene.
  enum class Bodies { kHere, kElsewhere };

  /// As publish().
  explicit SnapshotSlot(std::shared_ptr<const Snapshot> first, Bodies bodies = Bodies::kHere)
      : scenes_(prepare(std::move(first), bodies)), current_(&scenes_.back()), oldest_(current_) {}

  /// Whether the reader has taken the newest one, and needs none before it.
  bool taken() const {
    return waiting_.load(std::memory_order_acquire) == nullptr &&
           oldest_.load(std::memory_order_acquire) == &scenes_.back();
  }
  /// Makes the world of its bodies. Throws hl::Error where they cannot be made, and std::bad_alloc. Any thread.
  static Ready prepare(std::shared_ptr<const Snapshot> snapshot, Bodies bodies = Bodies::kHere) {
    Scene scene{std::move(snapshot), nullptr};
    scene.has_bodies = movingBodies(*scene.snapshot) > 0;
    if (bodies == Bodies::kHere) scene.bodies = BodyWorld::of(*scene.snapshot);
    Ready ready;
    ready.push_back(std::move(scene));
    return ready;
  }
  /// Frees the scene published before, if the reader has not taken it yet: it never sees that scene.
  void publish(Ready next) noexcept {
    scenes_.splice(scenes_.end(), next);
    const Scene* const untaken = waiting_.exchange(&scenes_.back(), std::memory_order_acq_rel);
    if (untaken != nullptr) scenes_.remove_if([&](const Scene& one) { return &one == untaken; });
  }
  void publish(std::shared_ptr<const Snapshot> next) { publish(prepare(std::move(next))); }
  /// Frees those that the reader needs no more. Publisher.
  void dropBefore() {
    const Scene* const oldest = oldest_.load(std::memory_order_acquire);
    while (&scenes_.front() != oldest) scenes_.pop_front();
  }
  /// The newest that was published. Publisher.
  const std::shared_ptr<const Snapshot>& newest() const { return scenes_.back().snapshot; }

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
  /// Of the scene that was taken; null: it has none, or another loop moves them. Reader; RT-safe.
  BodyWorld* bodies() const { return current_->bodies.get(); }
  /// Whether that scene has bodies that move. Reader; RT-safe.
  bool hasBodies() const { return current_->has_bodies; }

 private:
  std::list<Scene> scenes_;               // of the publisher: all that the reader may be in, the newest last
  std::atomic<Scene*> waiting_{nullptr};  // published and not taken
  Scene* current_;                        // of the reader
  std::atomic<const Scene*> oldest_;      // the reader needs none before it
};

}  // namespace hl
