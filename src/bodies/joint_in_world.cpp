#include "bodies/joint_in_world.h"

namespace hl {

JointPlace jointPlace(const Joint& joint, const World& world, const WorldState& state) {
  const auto pose = [&](std::uint64_t key) {
    const Body* const body = world.find(key);
    return body == nullptr ? Pose() : poseOf(*body, state.bodies[static_cast<std::size_t>(body - world.bodies.data())]);
  };
  return {joint, pose(joint.body_a), pose(joint.body_b)};
}

}  // namespace hl
