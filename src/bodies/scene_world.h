// Scene world: the world of the bodies of a snapshot.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bodies/world.h"

namespace hl {

/// Null: none of its instances moves as a body. Throws hl::Error, with the name of the body, where a shape or a mass
/// cannot be made, and where all bodies have more than kMaxBodies parts. Allocates.
std::shared_ptr<const World> worldOf(const Snapshot& snapshot);

/// The number of parts of all bodies that move. Throws Error, with the name of the body.
std::size_t partsIn(const Snapshot& snapshot);

/// One line for each shape of bodies of parts that is farther from its parts than kNearlyConvex of its size: how far,
/// and what to do. Throws Error, with the name of the body. Allocates.
std::vector<std::string> coverWarnings(const Snapshot& snapshot);

}  // namespace hl
