// Check bodies: whether the rigid bodies of a client can be made, before anything of its frame is shown.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/placed_shape.h"

namespace hl {

/// What the world of the bodies is made of, by numbers.
struct WorldParts {
  std::size_t bodies = 0;  ///< that move; of those with several parts, each part
  std::size_t joints = 0;

  WorldParts& operator+=(const WorldParts& more) {
    bodies += more.bodies;
    joints += more.joints;
    return *this;
  }
};
WorldParts partsOf(const Snapshot& scene);

/// Throws hl::Error, one line that names the object or joint, for a body whose shape or mass cannot be made, or a joint
/// that cannot be stepped. What was asked for before is known (made_bodies.h).
WorldParts checkBodies(const PlacedList& placed);

/// What is to be said of the bodies of parts that were not there before: see partsWarnings(). Each line names the
/// object.
std::vector<std::string> warningsOfNewBodies(const PlacedList& placed, const PlacedList& before);

/// `all`: of all clients and the server's own scene. Throws hl::Error where there are more than `most`, or bodies and
/// more devices than a world of bodies has hands.
void checkBodiesOfAll(const WorldParts& all, const WorldParts& most, std::size_t devices);
/// The same of the devices, for a scene.
void checkHandsAtBodies(const Snapshot& scene, std::size_t devices);

/// Of all that bodies of a client may meet, but for what other clients have; empty where it has none that move.
Box boundsForBodies(const Snapshot& base, const std::vector<PlacedShape>& placed);

}  // namespace hl
