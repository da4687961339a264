#include "scene/follow_body.h"

#include <string>

namespace hl {

namespace {

// It keeps its room while that holds the scene, so that a scene that grows a little does not make it anew.
bool isSame(const PlacedShape& now, const Instance& before, const Box& scene) {
  const RigidBody& body = *before.body;
  if (!(body.spec == *now.body) || !(body.start == now.pose)) return false;
  if (body.spec.fixed) return true;
  const Box &of_now = now.shape->bounds, &of_before = before.shape->bounds;
  return of_now.min == of_before.min && of_now.max == of_before.max && body.poses->room().contains(scene);
}

}  // namespace

std::shared_ptr<const RigidBody> followBody(const PlacedShape& now, const Instance* before, const Box& scene) {
  const bool had = before != nullptr && before->body;
  if (had && isSame(now, *before, scene)) return before->body;
  Box all = scene;
  all.extend(boxAt(now.shape->bounds, now.pose));
  auto body =
      makeRigidBody("object " + std::to_string(now.object), *now.body, now.pose, now.shape->bounds, roomAround(all));
  // Until a loop takes it, it is shown where it is going on from.
  if (had && body->poses && before->body->poses && before->body->start == body->start)
    body->poses->jumpTo(before->body->poses->shown());
  return body;
}

}  // namespace hl
