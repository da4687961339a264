// Append part: one model out of many objects, each moved to its place and given its material.
#pragma once

#include "scene/model.h"

namespace hl {

/// Multiplies texture coordinates.
void repeatTexcoords(Model& model, const Vec2& factors);

/// Appends `part` to `whole`, all of it with material number `material` of `whole`; its own materials are left out.
/// Where one of the two has normals or texture coordinates and the other has not, zeros fill the gap.
void appendPart(Model& whole, const Model& part, std::uint16_t material);

}  // namespace hl
