#include "scene/follow_body.h"

namespace hl {

namespace {

// It keeps its room while that holds the scene, so that a scene that grows a little does not make it anew.
bool isSame(const ClientBody& now, const Instance& before, const Box& scene) {
  const RigidBody& body = *before.body;
  if (!(body.spec == now.spec) || !(body.start == now.start)) return false;
  if (body.spec.fixed) return true;
  const Box& object = before.shape->bounds;
  return object.min == now.object.min && object.max == now.object.max && body.poses->room().contains(scene);
}

}  // namespace

std::shared_ptr<const RigidBody> followBody(const std::string& name, const ClientBody& now, const Instance* before,
                                            const Box& scene) {
  const bool had = before != nullptr && before->body;
  if (had && isSame(now, *before, scene)) return before->body;
  Box all = scene;
  all.extend(boxAt(now.object, now.start));
  auto body = makeRigidBody(name, now.spec, now.start, now.object, roomAround(all));
  // Until a loop takes it, it is shown where it is going on from.
  if (had && body->poses && before->body->poses && before->body->start == body->start)
    body->poses->jumpTo(before->body->poses->shown());
  return body;
}

}  // namespace hl
