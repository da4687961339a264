// Replayed scenes: the scenes of a recording, which its loops take one after the other, as they did.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "base/error.h"
#include "record/replayed_file.h"
#include "touch/snapshot_slot.h"

namespace hl {

/// All of a session, of which those are kept that a follower is still to take. One thread.
class ReplayedScenes {
 public:
  /// `read_on`: reads on in the recording; false: it has no more.
  explicit ReplayedScenes(std::function<bool()> read_on) : read_on_(std::move(read_on)) {}

  void add(ReplayedScene scene) {
    has_bodies_[scene.identity] = movingBodies(*scene.snapshot) > 0;
    scenes_.push_back(std::move(scene));
  }
  /// Whether this one has bodies that move; also of one that is not kept any more. Throws hl::Error: there is no such.
  bool hasBodies(std::uint64_t identity);
  std::size_t join() {
    next_.push_back(0);
    return next_.size() - 1;
  }
  /// The place of this one, in the order of all, at or after the follower's next one. Throws hl::Error: it is not
  /// there.
  std::uint64_t placeOf(std::uint64_t identity, std::size_t follower);
  const std::shared_ptr<const Snapshot>& at(std::uint64_t place) const { return scenes_[place - gone_].snapshot; }
  std::uint64_t nextOf(std::size_t follower) const { return next_[follower]; }
  void passed(std::size_t follower);

 private:
  void readOn();

  std::function<bool()> read_on_;
  std::deque<ReplayedScene> scenes_;
  std::map<std::uint64_t, bool> has_bodies_;  // of all so far, by identity
  std::vector<std::uint64_t> next_;           // of each follower
  std::uint64_t gone_ = 0;                    // before the first of scenes_
};

/// A loop that takes them in turn.
class SceneFollower {
 public:
  SceneFollower(ReplayedScenes& scenes, SnapshotSlot::Bodies bodies)
      : scenes_(scenes), number_(scenes.join()), bodies_(bodies) {}

  /// Shows each scene up to this one. `begin`: with the slot, once; `pass`: takes one that no tick was in.
  template <typename Begin, typename Pass>
  void show(std::uint64_t identity, const Begin& begin, const Pass& pass) {
    if (shown_ == identity) return;
    const std::uint64_t place = scenes_.placeOf(identity, number_);
    while (scenes_.nextOf(number_) <= place) {
      const std::shared_ptr<const Snapshot>& scene = scenes_.at(scenes_.nextOf(number_));
      if (slot_) {
        slot_->publish(SnapshotSlot::prepare(scene, bodies_));
      } else {
        slot_ = std::make_unique<SnapshotSlot>(scene, bodies_);
        begin();
      }
      if (scenes_.nextOf(number_) < place) {
        pass();
        slot_->dropBefore();
      }
      scenes_.passed(number_);
    }
    shown_ = identity;
  }
  SnapshotSlot& slot() { return *slot_; }

 private:
  ReplayedScenes& scenes_;
  const std::size_t number_;
  const SnapshotSlot::Bodies bodies_;
  std::unique_ptr<SnapshotSlot> slot_;
  std::uint64_t shown_ = 0;
};

}  // namespace hl
