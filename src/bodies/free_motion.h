// Free motion: how a body moves for one step with the velocity that the contacts have left it.
#pragma once

#include "bodies/world.h"

namespace hl {

/// Moves the centre by `way`, and turns the body freely for `period_s` (> 0) from its present spin: the angular
/// momentum stays the same to rounding, and the energy of a turn without contacts oscillates with the square of the
/// step. RT-safe.
void moveFreely(const Body& body, BodyState& state, const Vec3& way, double period_s);

}  // namespace hl
