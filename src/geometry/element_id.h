// ElementId: which primitive of one shape.
#pragma once

#include <cstdint>

namespace hl {

/// Counts from 0. Of 64 bits: a surface that makes its primitives on request may have more than a mesh can.
using ElementId = std::uint64_t;

}  // namespace hl
