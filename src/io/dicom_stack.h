// Slices of a DICOM series in space, and the grid that they make together.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/vec.h"
#include "surfaces/voxel_grid.h"

namespace hl {

/// One slice: a file, or a frame of one. In mm, in the axes of a patient, x to the left, y to the back, z to the head
/// (LPS).
struct DicomSlice {
  std::string path;
  std::size_t frame = 0;  ///< from 0
  Vec3 position{};        ///< of the middle of its first sample
  Vec3 along_row{};       ///< unit vector to the next sample, which is in the next column
  Vec3 along_column{};    ///< unit vector to the next row
  double column_step = 0, row_step = 0;
  ValueScale values{};
};

/// Sorts slices along their normal. Columns of the result: mm to the next sample, row and slice. The last is the way
/// from position to position, so a gantry that was tilted makes a sheared grid, and what a file says of its thickness
/// does not count. Throws hl::Error, with what it found, unless they are at least two, parallel and equally far apart.
Mat3 stackSlices(std::vector<DicomSlice>& slices);

}  // namespace hl
