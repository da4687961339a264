// The nodes of a WideBvh: frames aligned with the faces below them, and the boxes of their children in these frames. On
// a slope, axis-aligned boxes extend beyond the surface, so a sphere in contact enters many boxes without touching
// their contents. Boxes aligned with the slope avoid this.
#pragma once

#include "base/huge_pages.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// Sets the frame of each node. O(n) on all threads of oneTBB; the result does not depend on their number.
void orient(HugeVector<WideNode>& nodes, const HugeVector<WideBlock>& blocks);

/// The nodes with the bounds of their children, each in its frame, for the current blocks. Complexity as orient().
HugeVector<WideNode> enclosed(const HugeVector<WideNode>& nodes, const HugeVector<WideBlock>& blocks);

/// Expected number of boxes that a small query in the root's box enters: the sum of the box areas divided by the root's
/// area. 0 for no nodes.
double costOf(const HugeVector<WideNode>& nodes);

}  // namespace hl
