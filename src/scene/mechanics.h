// Mechanics: what acts on all rigid bodies of a scene.
#pragma once

#include "base/vec.h"

namespace hl {

struct Mechanics {
  Vec3 gravity_m_s2 = Vec3(0, -9.81, 0);
};

}  // namespace hl
