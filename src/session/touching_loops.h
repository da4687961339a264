// TouchingLoops: all loops that take a scene: those of each device, and that of their hands at bodies.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "touch/hand_group.h"
#include "touch/touch_session.h"

namespace hl {

/// One publisher, one thread at a time. The loops outlive it.
class TouchingLoops {
 public:
  /// One scene, for all of them.
  struct Scenes {
    std::vector<SnapshotSlot::Ready> of_devices;
    SnapshotSlot::Ready of_hands;
  };

  /// One device at least. `hands`: of several; null: there is one.
  TouchingLoops(std::vector<TouchSession*> devices, HandGroup* hands) : devices_(std::move(devices)), hands_(hands) {}

  std::size_t devices() const { return devices_.size(); }
  /// That is shown now.
  std::shared_ptr<const Snapshot> snapshot() const { return devices_.front()->snapshot(); }
  /// As SnapshotSlot::prepare().
  Scenes prepare(const std::shared_ptr<const Snapshot>& next) const;
  /// When they are ready(). `anew`: it is no change of the scene before, and is fitted to the hands.
  void publish(Scenes scenes, bool anew) noexcept;
  /// As TouchSession::ready(), of all.
  bool ready(std::int64_t since_ns) const;
  void dropSceneBefore();

 private:
  const std::vector<TouchSession*> devices_;
  HandGroup* const hands_;
};

}  // namespace hl
