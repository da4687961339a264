// How a WideBvh is asked: walks over its nodes and blocks, compiled for every instruction set the program may meet and
// chosen when it runs. Each proposes the same candidates in the same order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/function_ref.h"
#include "geometry/element_id.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// See SpatialIndex. RT-safe.
std::size_t overlapWide(const WideTree& tree, const WideQuery& query, FunctionRef<void(ElementId primitive)> visit);
/// `first_part`: of the motion, 0 < first_part <= 1; what is looked at before the rest.
std::size_t sweepWide(const WideTree& tree, const WideQuery& query, double first_part,
                      FunctionRef<double(ElementId primitive, double limit)> visit);

}  // namespace hl
