// Memory capture: what the proxy and the bodies remembered after a tick, taken by the loop that made it, when the
// recorder's thread wants it: where a recording begins that is a part of a session.
#pragma once

#include <recording.pb.h>

#include <atomic>
#include <cstdint>

#include "base/log_ring.h"
#include "record/recorded_ticks.h"
#include "record/scene_queue.h"

namespace hl {

/// take() by the loop, all else by one other thread.
class MemoryCapture {
 public:
  enum class State { kWaiting, kReady, kUseless };

  /// With room for the bodies of the scenes that are waited for. Allocates.
  void want(const SceneQueue& scenes);
  bool isWanted() const { return phase_.load(std::memory_order_acquire) == kWanted; }
  /// RT-safe. `next_tick`: number of the tick after this one.
  void take(const ProxyLoop& proxy, std::uint64_t scene, std::uint64_t next_tick) noexcept;
  /// Ready: a recording may begin with the next tick, which is in the scene of the last one. What the proxy keeps for a
  /// change of scenes is not captured.
  State stateAmong(const LogRing<TickRecord>& ticks) const;
  /// Of what is ready.
  proto::RecordingBlock block() const;
  std::uint64_t scene() const { return scene_; }
  std::uint64_t nextTick() const { return next_tick_; }

 private:
  enum Phase { kNone, kWanted, kTaken };
  std::atomic<Phase> phase_{kNone};
  ProxyMemory memory_;
  BodiesMemory bodies_;
  bool has_bodies_ = false, has_room_ = false;
  std::uint64_t scene_ = 0, next_tick_ = 0;
};

}  // namespace hl
