// A phantom for computed tomography: bodies of known form and density.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene_model.h"

namespace hl {

/// A ball of tissue of 60 mm, cut flat at a tilt of 20 degrees, on a neck; in it of bone a ball of 14 mm, a rod and a
/// tilted plate of 6 mm. In HU: air -1000, tissue 40, bone 700, and a linear ramp of two samples across each surface.
/// `side`: samples along each side of 160 mm. Its surfaces are the skin and the bones, halfway up their ramps.
SceneModel makePhantom(std::uint32_t side);

}  // namespace hl
