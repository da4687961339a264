#include "session/base_scene.h"

#include <utility>

namespace hl {

std::uint64_t BaseScene::replace(std::shared_ptr<const Snapshot> next) {
  const std::lock_guard lock(mutex_);
  next_.swap(next);  // one that has never been shown is freed without the mutex
  return ++last_;
}

void BaseScene::setIso(std::uint64_t key, const IsoChoice& choice) {
  const std::lock_guard lock(mutex_);
  isos_[key] = choice.after(isos_[key]);
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

void BaseScene::takeNext(std::uint64_t scene) {
  std::shared_ptr<const Snapshot> before;  // freed without the mutex
  std::map<std::uint64_t, IsoChoice> isos;
  {
    const std::lock_guard lock(mutex_);
    isos = isos_;
    if (next_) {
      before = std::exchange(now_, std::exchange(next_, nullptr));
      number_ = last_;
      other_ = true;
    }
  }
  if (isos.empty()) return;
  replaceSurfaces(isos, scene);
  const std::lock_guard lock(mutex_);  // what failed is tried again, what came meanwhile is for the next scene
  std::erase_if(isos_, [&](const auto& one) {
    const auto done = isos.find(one.first);
    return done != isos.end() && done->second == one.second;
  });
}

void BaseScene::replaceSurfaces(const std::map<std::uint64_t, IsoChoice>& isos, std::uint64_t scene) {
  std::vector<Instance> instances = now_->instances;
  bool any = false;
  for (Instance& instance : instances) {
    const auto iso = isos.find(instance.key + firstKey());
    if (iso == isos.end() || isoSurfaceOf(instance) == nullptr) continue;
    hl::setIso(instance, iso->second);
    instance.replaced_in = scene;
    any = true;
  }
  if (!any) return;
  now_ = makeSnapshot(std::move(instances), now_->name, now_->number, 0, now_->mechanics);
  last_replaced_ = scene;
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
