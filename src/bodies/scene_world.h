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

/// Of a body of parts, a line each: how its mesh counts if it is open, with its mass; how far it is from its parts if
/// that is more than kNearlyConvex of its size; and what to do. Throws Error. Allocates.
std::vector<std::string> partsWarnings(const std::shared_ptr<const Shape>& shape, const BodySpec& spec);
/// Of all bodies that move, each shape once, with the name of its first body. Throws Error with that. Allocates.
std::vector<std::string> bodyWarnings(const Snapshot& snapshot);

}  // namespace hl
