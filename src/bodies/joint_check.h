// Joint check: what a joint must hold to be stepped.
#pragma once

#include "bodies/world.h"

namespace hl {

/// A force table has no more rows: the work of a step is bounded.
inline constexpr std::size_t kMostTableRows = 256;

/// Throws Error with a line that says which joint, and what to do.
void checkJoint(const Joint& joint, const World& world);
/// All of the world; their keys increase.
void checkJoints(const World& world);

}  // namespace hl
