// From a sparse grid to a volume: the box of its active voxels, with one more on each side.
#pragma once

#include <openvdb/openvdb.h>

#include "io/volume_sink.h"

namespace hl {

/// A level set has its surface at 0 and its matter below; of other grids nothing is said. It lies where the file says,
/// one unit of the file being a metre. Throws hl::Error for what cannot be a volume.
void giveVolume(const openvdb::FloatGrid& grid, VolumeSink& sink);

}  // namespace hl
