// The nodes of a WideBvh after its primitives have moved: the same tree with other boxes, and how good it is.
#pragma once

#include <vector>

#include "base/huge_pages.h"
#include "geometry/wide_bvh_build.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// The same nodes around `blocks`, the boxes of their blocks now. O(n), on the calling thread: there is one node for
/// forty primitives.
HugeVector<WideNode> refitted(const HugeVector<WideNode>& nodes, const std::vector<FloatBox>& blocks);

/// Boxes entered by a small query somewhere in the root's box: the sum of their areas in parts of the root's. 0 for no
/// nodes.
double costOf(const HugeVector<WideNode>& nodes);

}  // namespace hl
