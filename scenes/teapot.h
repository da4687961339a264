// The teapot from Newell's Bezier patches, y up, 0.2 m from handle to spout, with exact normals.
#pragma once

#include "scene/model.h"

namespace hl {

/// `around` cells across and `along` cells down each patch. The default gives 3408 triangles, the nearest number to the
/// paper's 3416 for 32 equal patches; triangles without area at the centres of lid and bottom are left out.
Model makeTeapot(int around = 6, int along = 9);

}  // namespace hl
