#include "record/memory_capture.h"

#include "record/recorded_bodies.h"
#include "record/recorded_proxy.h"

namespace hl {

// While the loops may write to it nothing here does.
void MemoryCapture::want(const SceneQueue& scenes) {
  if (!isWanted()) bodies_.reserve(scenes.mostBodies(), scenes.mostJoints());
  phase_.store(kWanted, std::memory_order_release);
}

void MemoryCapture::take(const ProxyLoop& proxy, std::uint64_t scene, std::uint64_t next_tick) noexcept {
  if (!isWanted()) return;
  memory_ = proxy.memory();
  has_bodies_ = proxy.bodies() != nullptr;
  has_room_ = proxy.remember(bodies_);
  scene_ = scene;
  next_tick_ = next_tick;
  phase_.store(kTaken, std::memory_order_release);
}

MemoryCapture::State MemoryCapture::stateAmong(const LogRing<TickRecord>& ticks) const {
  TickRecord next;
  if (phase_.load(std::memory_order_acquire) != kTaken || ticks.pushed() == next_tick_) return State::kWaiting;
  const bool goes_on = ticks.read(next_tick_, next) && next.scene == scene_;
  return has_room_ && goes_on ? State::kReady : State::kUseless;
}

proto::RecordingBlock MemoryCapture::block() const {
  proto::RecordingBlock block;
  toProto(memory_, *block.mutable_proxy());
  if (has_bodies_) toProto(bodies_, *block.mutable_proxy()->mutable_bodies());
  return block;
}

}  // namespace hl
