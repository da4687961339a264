// The nodes of a WideBvh: frames along the faces beneath them, and the boxes of their children there. On a slope, boxes
// along the axes stick out of the surface, so a sphere that touches it enters many that it does not touch; boxes along
// the slope do not.
#pragma once

#include "base/huge_pages.h"
#include "geometry/wide_bvh_layout.h"

namespace hl {

/// Sets the frame of each node. O(n), on all threads that oneTBB has; the result does not depend on their number.
void orient(HugeVector<WideNode>& nodes, const HugeVector<WideBlock>& blocks);

/// The nodes with their boxes, each in its frame, around the blocks where they are now. As orient().
HugeVector<WideNode> enclosed(const HugeVector<WideNode>& nodes, const HugeVector<WideBlock>& blocks);

/// Boxes entered by a small query somewhere in the root's box: the sum of their areas in parts of the root's. 0 for no
/// nodes.
double costOf(const HugeVector<WideNode>& nodes);

}  // namespace hl
