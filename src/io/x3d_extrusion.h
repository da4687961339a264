// Extrusion of X3D (ISO/IEC 19775-1, 13.3.5): a cross-section that is drawn along a spine.
#pragma once

#include "io/x3d_document.h"

namespace hl {

/// Its fields become those of an IndexedFaceSet, with its coordinates. Sections are at right angles to the spine, of a
/// straight one too, which assimp turns only about y.
void makeExtrusion(X3dTree& extrusion);

}  // namespace hl
