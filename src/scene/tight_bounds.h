// Tight bounds: what a scene fills. Snapshot::bounds, by which it is found, may be larger, as bricks and grids are.
#pragma once

#include "geometry/box.h"
#include "scene/snapshot.h"

namespace hl {

/// As tightBox(); but of a height field the box of its grid, as what comes from beside meets too many of its triangles.
Box tightBounds(const PrimitiveSource& source, const SpatialIndex& index, const Mat3& turn = Mat3::Identity());

/// Of all instances when their motion is over, and of bodies where they are now; of surfaces that make their primitives
/// as above.
Box tightBounds(const Snapshot& snapshot);

}  // namespace hl
