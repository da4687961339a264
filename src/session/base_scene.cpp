#include "session/base_scene.h"

#include <utility>

namespace hl {

std::uint64_t BaseScene::replace(std::shared_ptr<const Snapshot> next) {
  const std::lock_guard lock(mutex_);
  next_.swap(next);  // one that has never been shown is freed without the mutex
  return ++last_;
}

bool BaseScene::awaitShown(std::uint64_t number) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !open_ || shown_ >= number; });
  return shown_ >= number;
}

void BaseScene::open() {
  const std::lock_guard lock(mutex_);
  open_ = true;
}

void BaseScene::stop() {
  const std::lock_guard lock(mutex_);
  open_ = false;
  changed_.notify_all();
}

void BaseScene::takeNext() {
  std::shared_ptr<const Snapshot> before;  // freed without the mutex
  const std::lock_guard lock(mutex_);
  if (!next_) return;
  before = std::exchange(now_, std::exchange(next_, nullptr));
  number_ = last_;
  other_ = true;
}

// Its keys begin there. A base is one object, or few, numbered from 1; clients' keys are scattered over all numbers.
std::uint64_t BaseScene::firstKey() const {
  constexpr int kBitsOfKey = 16;
  return (number_ - 1) << kBitsOfKey;
}

void BaseScene::appendTo(std::vector<Instance>& instances) const {
  for (const Instance& instance : now_->instances) {
    instances.push_back(instance);
    instances.back().key += firstKey();
  }
}

Mechanics BaseScene::mechanics() const {
  Mechanics mechanics = now_->mechanics;
  for (JointSpec& joint : mechanics.joints) {
    joint.body_a += firstKey();
    if (joint.body_b > 0) joint.body_b += firstKey();
  }
  return mechanics;
}

void BaseScene::markShown() {
  other_ = false;
  const std::lock_guard lock(mutex_);
  shown_ = number_;
  changed_.notify_all();
}

}  // namespace hl
