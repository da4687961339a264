// The teapot from Newell's Bezier patches, y up, 0.2 m from handle to spout, with exact normals.
#pragma once

#include "scene/model.h"

namespace hl {

/// `around` cells across and `along` cells down each patch. The default gives 3408 triangles, the nearest to the
/// paper's 3416 that 32 equal patches give when the triangles of no area at lid and bottom centre are left out.
Model makeTeapot(int around = 6, int along = 9);

}  // namespace hl
