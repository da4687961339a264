// Tight bounds: what a scene fills. Snapshot::bounds, by which it is found, may be larger, as bricks and grids are.
#pragma once

#include "geometry/box.h"
#include "scene/snapshot.h"

namespace hl {

/// Of all instances when their motion is over, and of bodies where they are now; of surfaces that make their primitives
/// as tightBox() says.
Box tightBounds(const Snapshot& snapshot);

}  // namespace hl
