// Rough: a family of terrains with detail of every size, from half the side of the scene down to the proxy. Members
// differ in all that is free: so a finger meets what no scene was made for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/model.h"

namespace hl {

/// About so many triangles, y up, 0.2 m across, with exact normals. The same member is the same to the bit everywhere.
Model makeRough(std::size_t triangles, std::uint64_t member);

}  // namespace hl
