// SampleBound: on which side of a value the samples of a grid are, by one comparison with a sample as it is stored.
//
// The value of a sample, rounded as it is, rises with the sample or falls with it: the samples on one side are those
// from a least one on.
#pragma once

#include "surfaces/voxel_grid.h"

namespace hl {

/// Two samples that are not missing are on different sides if and only if one is at least the bound and the other is
/// not.
struct SampleBound {
  SampleBound() = default;
  /// Bisection: some 40 values are looked at. `inward`: 1: inside are values of at least `value`; -1: of at most.
  SampleBound(const VoxelGrid& grid, double value, double inward);

  std::int32_t whole = 0;  ///< of integers
  float real = 0;          ///< of floats
};

}  // namespace hl
