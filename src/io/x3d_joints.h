// Joints of an X3D file (ISO/IEC 19775-1, clause 37): BallJoint, SingleAxisHingeJoint, SliderJoint.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/x3d_document.h"
#include "scene/scene_model.h"

namespace hl {

/// Of each RigidBody that is in the scene its place among the bodies, from 1.
using X3dBodyNumbers = std::map<const X3dNode*, std::uint64_t>;

/// Adds the joints of all collections. What is not supported, or joins nothing that moves, becomes a warning.
void readX3dJoints(const X3dDocument& document, const X3dBodyNumbers& numbers, SceneModel& scene,
                   std::vector<std::string>& warnings);

}  // namespace hl
