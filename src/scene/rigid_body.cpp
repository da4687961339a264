#include "scene/rigid_body.h"

#include <utility>

#include "geometry/primitive.h"

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
  // Of a mesh whose vertices are beyond that, what is there to touch is not.
  const auto reached = [](const Vec3& corner) { return corner.cwiseMax(-kFarthest_m).cwiseMin(kFarthest_m); };
  const Box near{reached(bounds.min), reached(bounds.max)};
  const Vec3 margin = Vec3::Constant(near.size().maxCoeff());
  return {near.min - margin, near.max + margin};
}

}  // namespace hl
