// Tight box: what a surface that makes its primitives fills, where its bounds may be those of its grid.
#pragma once

#include "geometry/box.h"
#include "geometry/primitive_source.h"
#include "geometry/spatial_index.h"

namespace hl {

/// The box of its primitives along the axes of another frame, whose coordinates are turn x: no side of it lies beyond
/// them, and it is short of them by some 1/20 000 of the diagonal of source.bounds(), or a few times as much where
/// thousands of primitives are about as high. Empty: there are none. `index`: the source's own. Some sweeps; setup
/// only.
Box tightBox(const PrimitiveSource& source, const SpatialIndex& index, const Mat3& turn = Mat3::Identity());

}  // namespace hl
