// Rough: a family of random terrains with detail of all sizes, from half the side of the scene down to the proxy. All
// free parameters differ between members, so tests meet surfaces that were not designed for them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/model.h"

namespace hl {

/// About `triangles` triangles, y up, 0.2 m across, with exact normals. The same member has the same bits on every
/// machine.
Model makeRough(std::size_t triangles, std::uint64_t member);

}  // namespace hl
