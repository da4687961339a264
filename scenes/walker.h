// A four-legged walker of 11 088 triangles, in the place of the paper's Figure 9: many intersecting boxes, cylinders
// and plates without thickness, with gaps between them, as graphics models are.
#pragma once

#include <cstddef>

#include "scene/model.h"

namespace hl {

inline constexpr std::size_t kWalkerTriangles = 11'088;

/// y up, the head toward +x, about 0.25 m long.
Model makeWalker();

}  // namespace hl
