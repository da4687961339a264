// A four-legged walker of 11 088 triangles, a replacement for the paper's Figure 9: many intersecting boxes, cylinders
// and plates of zero thickness, with gaps between them, as is usual in graphics models.
#pragma once

#include <cstddef>

#include "scene/model.h"

namespace hl {

inline constexpr std::size_t kWalkerTriangles = 11'088;

/// y up, the head toward +x, about 0.25 m long.
Model makeWalker();

}  // namespace hl
