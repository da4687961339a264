// The order of the points of a cloud: near ones follow each other, so that CloudPoints::kPerBlock of them make a small
// block, and kPerNode blocks, nodes and so on a small node.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/cloud_points.h"

namespace hl {

/// A point by its steps along the axes of the lattice, and its normal (packed_normal.h); in a list of colours, its
/// colour (rgb.h) in the place of that.
struct LatticePoint {
  std::array<std::int32_t, 3> at;
  std::uint32_t normal;
};

/// By coordinates, each place once. The order in which the points came does not matter.
void sortPoints(std::vector<LatticePoint>& points);

/// Splits them in two at the middle of the longest side, again and again, down to blocks. The number of blocks before
/// each split is a power of two, so that nodes are whole parts.
void arrangePoints(std::vector<LatticePoint>& points, const Vec3& step);

/// By how many powers of two the lattice may be coarser so that nearly all blocks keep their points in 16 bits.
int coarserBy(const std::vector<LatticePoint>& arranged);

/// Rounds the points to a lattice that is coarser by so many powers of two.
void coarsen(std::vector<LatticePoint>& points, CloudLattice& lattice, int powers);

}  // namespace hl
