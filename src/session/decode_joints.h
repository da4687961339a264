// Decodes the joints of a client's frame.
#pragma once

#include <hl.pb.h>

#include <vector>

#include "base/memory_budget.h"
#include "io/decode_scene.h"
#include "scene/placed_joints.h"
#include "scene/scene_limits.h"

namespace hl {

/// Of the frame's world. Their memory is counted in `memory`. Throws hl::Error, one line with the id of the joint, for
/// one that makes no sense by itself; which bodies there are is not looked at.
std::vector<CalledJoint> decodeJoints(const proto::World& world, const SceneDecoder& decoder, const SceneLimits& limits,
                                      MemoryShare& memory);

}  // namespace hl
