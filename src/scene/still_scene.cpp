#include "scene/still_scene.h"

#include <cstddef>
#include <utility>

namespace hl {

const Snapshot& StillScene::of(const std::shared_ptr<const Snapshot>& scene) {
  if (scene_ != scene) {
    scene_ = scene;
    copy();
  }
  if (!copy_) return *scene_;
  std::size_t number = 0;
  for (const Instance& instance : scene_->instances) {
    if (instance.movesAsBody()) standing_[number++]->jumpTo(instance.body->poses->shown());
  }
  return *copy_;
}

void StillScene::copy() {
  copy_.reset();
  standing_.clear();
  if (movingBodies(*scene_) == 0) return;
  copy_ = std::make_unique<Snapshot>(*scene_);
  for (Instance& instance : copy_->instances) {
    if (!instance.movesAsBody()) continue;
    const BodyPoses& moving = *instance.body->poses;
    standing_.push_back(std::make_shared<BodyPoses>(moving.shown().pose, moving.object(), moving.room()));
    auto body = std::make_shared<RigidBody>(*instance.body);
    body->poses = standing_.back();
    instance.driver = standing_.back();
    instance.body = std::move(body);
  }
}

}  // namespace hl
