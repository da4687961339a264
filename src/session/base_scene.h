// BaseScene: what can be touched besides the clients' objects, and how another one takes its place.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "scene/iso_shape.h"
#include "scene/snapshot.h"

namespace hl {

class BaseScene {
 public:
  explicit BaseScene(std::shared_ptr<const Snapshot> first) : now_(std::move(first)) {}

  // Any thread.
  /// The next one; returns its number.
  std::uint64_t replace(std::shared_ptr<const Snapshot> next);
  /// From the next scene on the surface of a volume with this key, as given in the scene that is shown, is at another
  /// value, or its matter on the other side; of several choices the last one counts. Nothing happens if that surface
  /// has gone by then.
  void setIso(std::uint64_t key, const IsoChoice& choice);
  /// Waits until the one of this number, or a later one, is shown. False: the publisher has stopped before.
  bool awaitShown(std::uint64_t number);
  void open();  ///< the publisher starts
  void stop();  ///< it has stopped: nobody waits any more

  // The publisher's thread.
  /// What waits is the base from now on, first in the scene of this number.
  void takeNext(std::uint64_t scene);
  const std::shared_ptr<const Snapshot>& now() const { return now_; }
  bool other() const { return other_; }  ///< than in the scene that is shown
  /// Number of the last scene in which a surface came to another value; 0: none.
  std::uint64_t lastReplaced() const { return last_replaced_; }
  /// Its objects, for the next scene; those of another base have other keys.
  void appendTo(std::vector<Instance>& instances) const;
  /// What acts on them there.
  Mechanics mechanics() const;
  void markShown();

 private:
  std::uint64_t firstKey() const;
  void replaceSurfaces(const std::map<std::uint64_t, IsoChoice>& isos, std::uint64_t scene);

  std::shared_ptr<const Snapshot> now_;
  std::uint64_t number_ = 1;  // of now_, from 1 on
  bool other_ = false;
  std::uint64_t last_replaced_ = 0;

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::shared_ptr<const Snapshot> next_;     // waits for the publisher; null: none does
  std::map<std::uint64_t, IsoChoice> isos_;  // wait for the publisher, by key
  std::uint64_t last_ = 1, shown_ = 1;       // numbers
  bool open_ = false;
};

}  // namespace hl
