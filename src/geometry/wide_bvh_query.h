// Queries of a WideBvh: traversals of its nodes and blocks, compiled for every supported instruction set and selected
// at run time. All versions propose the same candidates in the same order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/function_ref.h"
#include "geometry/element_id.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// SpatialIndex::overlapUntil. RT-safe.
std::size_t overlapWide(const WideTree& tree, const WideQuery& query, FunctionRef<bool(ElementId primitive)> stop);
/// SpatialIndex::sweep. RT-safe.
/// `first_part`: the fraction of the motion that is searched first, 0 < first_part <= 1.
std::size_t sweepWide(const WideTree& tree, const WideQuery& query, double first_part,
                      FunctionRef<double(ElementId primitive, double limit)> visit);

}  // namespace hl
