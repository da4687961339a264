// Polar decomposition: what a client's matrix does to a shape, split into a turn and a stretch. A stretched shape is
// built once; a turned one is only placed.
#pragma once

#include "base/vec.h"

namespace hl {

/// linear = rotation * stretch, which is unique. `stretch` is symmetric; of a mirrored object it has all axes negative.
/// Without unit.
struct Polar {
  Mat3 rotation, stretch;
};

/// Any thread. Stretches that differ by rounding alone are the same bits. Throws hl::Error for a matrix that is not
/// finite, or that flattens.
Polar polarOf(const Mat3& linear);

}  // namespace hl
