// How a WideBvh is asked: walks over its nodes and blocks, compiled for every instruction set the program may meet and
// chosen when it runs. Each proposes the same candidates in the same order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/function_ref.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

struct WideTree {
  const WideNode* nodes;
  const WideBlock* blocks;
  std::uint32_t root;        ///< a link
  std::uint32_t primitives;  ///< at least one; number k is in block k / 8
  double extent;             ///< m: largest coordinate of its boxes
};

/// Relative to the hierarchy's origin, metres. `reach` is the radius with all that double arithmetic may be off by.
struct WideQuery {
  double from[3];
  double motion[3];
  double reach;
};

/// See SpatialIndex. RT-safe.
std::size_t overlapWide(const WideTree& tree, const WideQuery& query, FunctionRef<void(std::uint32_t primitive)> visit);
/// `first_part`: of the motion, 0 < first_part <= 1; what is looked at before the rest.
std::size_t sweepWide(const WideTree& tree, const WideQuery& query, double first_part,
                      FunctionRef<double(std::uint32_t primitive, double limit)> visit);

}  // namespace hl
