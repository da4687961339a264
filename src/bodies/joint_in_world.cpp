#include "bodies/joint_in_world.h"

namespace hl {

JointPlace jointPlace(const Joint& joint, const World& world, const WorldState& state) {
  const auto pose = [&](std::uint64_t key) {
    const std::size_t body = world.numberOf(key);
    return body == World::kNoBody ? Pose() : poseOf(world.bodies[body], state.bodies[body]);
  };
  return {joint, pose(joint.body_a), pose(joint.body_b)};
}

}  // namespace hl
