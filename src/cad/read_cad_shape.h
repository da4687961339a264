// Reads STEP, IGES and BREP files by OpenCASCADE.
#pragma once

#include <functional>

#include "cad/cad_shape.h"
#include "io/model_file.h"

namespace hl {

/// Opens no other file, and forbids that for good. Throws hl::Error for a file that cannot be used. `report` is given
/// how far it is, 0..1.
CadShape readCadShape(const ModelFile& file, const std::function<void(double)>& report);

}  // namespace hl
