// What a depth camera above a table sees: a ball, a box and a cone on it, each with its shadow, in which there is no
// depth.
#pragma once

#include <memory>

#include "surfaces/depth_frame.h"

namespace hl {

/// 640 x 480 depths of 0.1 mm, of a camera half a metre above the table that looks down at it. The table is y = 0, and
/// the middle of the picture is at the origin.
std::shared_ptr<const PrimitiveSource> makeDepthTable();

}  // namespace hl
