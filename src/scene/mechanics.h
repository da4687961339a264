// Mechanics: what acts on all rigid bodies of a scene.
#pragma once

#include <vector>

#include "base/vec.h"
#include "scene/joint_spec.h"

namespace hl {

struct Mechanics {
  Vec3 gravity_m_s2 = Vec3(0, -9.81, 0);
  std::vector<JointSpec> joints;
};

}  // namespace hl
