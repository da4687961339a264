#include "scene/rigid_body.h"

#include <utility>

namespace hl {

std::shared_ptr<const RigidBody> makeRigidBody(std::string name, const BodySpec& spec, const Pose& start,
                                               const Box& object, const Box& room) {
  auto body = std::make_shared<RigidBody>();
  body->name = std::move(name);
  body->spec = spec;
  body->start = start;
  if (!spec.fixed) body->poses = std::make_shared<BodyPoses>(start, object, room);
  return body;
}

Box roomAround(const Box& bounds) {
  if (bounds.empty()) return bounds;
  const Vec3 margin = Vec3::Constant(bounds.size().maxCoeff());
  return {bounds.min - margin, bounds.max + margin};
}

}  // namespace hl
