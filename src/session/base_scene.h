// BaseScene: what can be touched besides the clients' objects, and how another one takes its place.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "scene/snapshot.h"

namespace hl {

class BaseScene {
 public:
  explicit BaseScene(std::shared_ptr<const Snapshot> first) : now_(std::move(first)) {}

  // Any thread.
  /// The next one; returns its number.
  std::uint64_t replace(std::shared_ptr<const Snapshot> next);
  /// Waits until the one of this number, or a later one, is shown. False: the publisher has stopped before.
  bool awaitShown(std::uint64_t number);
  void open();  ///< the publisher starts
  void stop();  ///< it has stopped: nobody waits any more

  // The publisher's thread.
  void takeNext();  ///< what waits is the base from now on
  const std::shared_ptr<const Snapshot>& now() const { return now_; }
  bool other() const { return other_; }  ///< than in the scene that is shown
  /// Its objects, for the next scene; those of another base have other keys.
  void appendTo(std::vector<Instance>& instances) const;
  /// What acts on them there.
  Mechanics mechanics() const;
  void markShown();

 private:
  std::uint64_t firstKey() const;

  std::shared_ptr<const Snapshot> now_;
  std::uint64_t number_ = 1;  // of now_, from 1 on
  bool other_ = false;

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::shared_ptr<const Snapshot> next_;  // waits for the publisher; null: none does
  std::uint64_t last_ = 1, shown_ = 1;    // numbers
  bool open_ = false;
};

}  // namespace hl
