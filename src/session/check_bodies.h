// Check bodies: whether the rigid bodies of a client can be made, before anything of its frame is shown.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/editable_scene.h"

namespace hl {

/// How many of them move. Throws hl::Error, one line that names the object, for one whose shape or mass cannot be made;
/// `before` are known to be good.
std::size_t checkBodies(const std::vector<PlacedShape>& placed, const std::vector<PlacedShape>& before);

}  // namespace hl
