// SceneQueue: the scenes that the loops take, until the recorder has written them. One that writes parts of a session
// keeps those that the loops may still be in, as a part may begin at any time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "scene/snapshot.h"

namespace hl {

/// Any thread; never the loops.
class SceneQueue {
 public:
  /// Without memory for it the queue has lost one.
  void push(std::shared_ptr<const Snapshot> scene) noexcept;
  bool hasLost() const;
  /// The most bodies that move in one of them.
  std::size_t mostBodies() const;
  std::size_t mostJoints() const;  ///< the same of their joints
  /// The first that is not written; null: there is none.
  std::shared_ptr<const Snapshot> next() const;
  /// It is. `keep_last`: it stays, if no other one follows.
  void written(bool keep_last);
  /// A part of the session begins in this scene: those before are dropped, it and the others are not written. Null: it
  /// is not there.
  std::shared_ptr<const Snapshot> beginAt(std::uint64_t identity);
  /// Nothing is being written: all go but the one that the loops are in, if they are in any, and those after it.
  void forgetBefore(std::optional<std::uint64_t> identity);

 private:
  std::deque<std::shared_ptr<const Snapshot>>::iterator find(std::uint64_t identity);  // holding mutex_

  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const Snapshot>> scenes_;
  std::size_t written_ = 0;  // of the first ones
  bool lost_ = false;
};

}  // namespace hl
