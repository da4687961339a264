// What every reader of volumes says of a volume: its sides, and where it lies.
#pragma once

#include <array>
#include <cstdint>

#include "surfaces/grid_frame.h"

namespace hl {

/// Sides as a file counts them. Throws hl::Error, with what they are, if no volume can have them.
std::array<std::uint32_t, 3> volumeSides(const std::array<double, 3>& counts);
/// How many samples that is.
std::uint64_t samplesIn(const std::array<std::uint32_t, 3>& side);

/// From axes of a patient, x to the right hand, y to the front, z to the head (RAS), to HL's: x right, y up, z to
/// whoever looks, who sees the back.
Mat3 fromPatient(const Mat3& axes);

/// Whether the columns, in metres, are of a size that can be and span space.
bool spansSpace(const Mat3& axes);
/// These axes, in metres, with the middle of the grid at the origin. Throws hl::Error unless they span space.
GridFrame centredFrame(const std::array<std::uint32_t, 3>& side, const Mat3& axes);

}  // namespace hl
