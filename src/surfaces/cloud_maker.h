// Makes the points of a cloud: their lattice, their order, and the normals that lack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "surfaces/cloud_order.h"
#include "surfaces/cloud_points.h"

namespace hl {

/// What a cloud is made of.
struct CloudInput {
  std::vector<LatticePoint> points;
  std::vector<LatticePoint> colours{};  ///< the same points, each with its colour, in any order; empty: there are none
  CloudLattice lattice;
  /// Whether it is the lattice of the source: points lie on it exactly. Else it is finer than needed.
  bool exact = false;
  /// As exact, and came from a cloud that was made before: nothing is rounded.
  bool made_before = false;
};

/// Positions in metres on a lattice that is as fine as 32 bits allow; `normals` and `colours`: one each, or none.
/// Throws hl::Error where they lie too far out, or some so far from the others that points which differ would be one;
/// what is not finite is left out and counted in `skipped`.
CloudInput onFineLattice(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& normals,
                         std::size_t& skipped, const std::vector<Rgb>& colours = {});

/// Points that are the same are one. Normals that lack are those of the plane through the nearest
/// CloudNeighbours::kNeighbours points. The order of the points does not matter. Throws hl::Error if there are none. On
/// all threads of oneTBB.
std::shared_ptr<const CloudPoints> makeCloud(CloudInput input);

}  // namespace hl
