// Check bodies: whether the rigid bodies of a client can be made, before anything of its frame is shown.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/editable_scene.h"

namespace hl {

/// How many of them move. Throws hl::Error, one line that names the object, for one whose shape or mass cannot be made;
/// `before` are known to be good.
std::size_t checkBodies(const std::vector<PlacedShape>& placed, const std::vector<PlacedShape>& before);

/// `all`: those that move, of all clients and the server's own scene. Throws hl::Error where they are too many, or
/// there are several devices: their world is moved by the loop of one.
void checkBodiesOfAll(std::size_t all, std::size_t most, std::size_t devices);

/// Of all that bodies of a client may meet, but for what other clients have; empty where it has none that move.
Box boundsForBodies(const Snapshot& base, const std::vector<PlacedShape>& placed);

}  // namespace hl
