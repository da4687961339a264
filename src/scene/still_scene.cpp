#include "scene/still_scene.h"

#include <cstddef>
#include <utility>

namespace hl {

const Snapshot& StillScene::of(const std::shared_ptr<const Snapshot>& scene) {
  if (scene_ != scene) {
    clear();
    copy(*scene);
    scene_ = scene;  // when the copy is whole
  }
  if (!copy_) return *scene_;
  std::size_t number = 0;
  for (const Instance& instance : scene_->instances) {
    if (instance.movesAsBody()) standing_[number++]->jumpTo(instance.body->poses->shown());
  }
  return *copy_;
}

void StillScene::clear() {
  scene_.reset();
  copy_.reset();
  standing_.clear();
}

void StillScene::copy(const Snapshot& scene) {
  if (movingBodies(scene) == 0) return;
  copy_ = std::make_unique<Snapshot>(scene);
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
