#include "session/touching_loops.h"

#include <algorithm>
#include <utility>

namespace hl {

TouchingLoops::Scenes TouchingLoops::prepare(const std::shared_ptr<const Snapshot>& next) const {
  Scenes scenes;
  for (const TouchSession* device : devices_) scenes.of_devices.push_back(device->prepare(next));
  if (hands_ != nullptr) scenes.of_hands = SnapshotSlot::prepare(next);
  return scenes;
}

void TouchingLoops::publish(Scenes scenes, bool anew) noexcept {
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    SnapshotSlot::Ready& scene = scenes.of_devices[i];
    anew ? devices_[i]->publishAnew(std::move(scene)) : devices_[i]->publish(std::move(scene));
  }
  if (hands_ != nullptr) hands_->publish(std::move(scenes.of_hands));
}

bool TouchingLoops::ready(std::int64_t since_ns) const {
  if (hands_ != nullptr && !hands_->ready(since_ns)) return false;
  return std::all_of(devices_.begin(), devices_.end(),
                     [&](const TouchSession* device) { return device->ready(since_ns); });
}

void TouchingLoops::dropSceneBefore() {
  if (hands_ != nullptr) hands_->dropSceneBefore();
  for (TouchSession* device : devices_) device->dropSceneBefore();
}

}  // namespace hl
