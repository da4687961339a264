#include "record/scene_queue.h"

#include <algorithm>
#include <utility>

#include "base/guarded_thread.h"

namespace hl {

void SceneQueue::push(std::shared_ptr<const Snapshot> scene) noexcept {
  const bool kept = guarded([&] {
    const std::lock_guard lock(mutex_);
    scenes_.push_back(std::move(scene));
  });
  if (kept) return;
  const std::lock_guard lock(mutex_);
  lost_ = true;
}

bool SceneQueue::hasLost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

std::size_t SceneQueue::mostBodies() const {
  const auto moves = [](const Instance& instance) { return instance.movesAsBody(); };
  const std::lock_guard lock(mutex_);
  std::ptrdiff_t most = 0;
  for (const auto& scene : scenes_)
    most = std::max(most, std::count_if(scene->instances.begin(), scene->instances.end(), moves));
  return static_cast<std::size_t>(most);
}

std::size_t SceneQueue::mostJoints() const {
  const std::lock_guard lock(mutex_);
  std::size_t most = 0;
  for (const auto& scene : scenes_) most = std::max(most, scene->mechanics.joints.size());
  return most;
}

std::shared_ptr<const Snapshot> SceneQueue::next() const {
  const std::lock_guard lock(mutex_);
  return written_ == scenes_.size() ? nullptr : scenes_[written_];
}

void SceneQueue::written(bool keep_last) {
  const std::lock_guard lock(mutex_);
  ++written_;
  for (; written_ > (keep_last ? 1 : 0); --written_) scenes_.pop_front();
}

std::shared_ptr<const Snapshot> SceneQueue::beginAt(std::uint64_t identity) {
  const std::lock_guard lock(mutex_);
  written_ = 0;
  lost_ = false;
  const auto begin = find(identity);
  if (begin == scenes_.end()) return nullptr;
  scenes_.erase(scenes_.begin(), begin);
  return scenes_.front();
}

void SceneQueue::forgetBefore(std::optional<std::uint64_t> identity) {
  constexpr std::size_t kMax = 2;  // the one that the loops are in, and the one that they have not taken yet
  const std::lock_guard lock(mutex_);
  written_ = 0;
  const auto used = identity ? find(*identity) : scenes_.end();
  if (used != scenes_.end()) scenes_.erase(scenes_.begin(), used);
  while (scenes_.size() > kMax) scenes_.pop_front();
}

std::deque<std::shared_ptr<const Snapshot>>::iterator SceneQueue::find(std::uint64_t identity) {
  return std::find_if(scenes_.begin(), scenes_.end(),
                      [identity](const auto& scene) { return scene->identity == identity; });
}

}  // namespace hl
