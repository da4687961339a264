// ElementId: number of a primitive in one shape.
#pragma once

#include <cstdint>

namespace hl {

/// Counts from 0. 64 bits, as a surface that computes its primitives on request may have more than a mesh can.
using ElementId = std::uint64_t;

}  // namespace hl
