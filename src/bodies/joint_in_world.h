// Joint in world: where a joint is in a state of its world.
#pragma once

#include "bodies/joint_place.h"
#include "bodies/world.h"

namespace hl {

/// RT-safe.
JointPlace jointPlace(const Joint& joint, const World& world, const WorldState& state);

}  // namespace hl
