// The faces of a CAD shape as triangles. Each edge is divided once for both of its faces, so that there are no cracks;
// each vertex has the normal of its face's own surface there, so that a curved face is smooth, and an edge between two
// faces is as sharp as they make it.
#pragma once

#include <cstddef>
#include <functional>

#include "cad/cad_shape.h"
#include "io/cad_file.h"
#include "scene/model.h"

namespace hl {

/// Metres of a shape in millimetres. Each of its solids is a part of the model, and so is what belongs to none. Edges
/// that belong to no face become segments. Its reading says how exact it is.
/// Throws hl::Error if there were more than `most_triangles`, with a deflection that gives fewer. `report` is given how
/// far it is, 0..1.
Model meshCad(const CadShape& cad, const CadMeshing& meshing, const std::function<void(double)>& report,
              std::size_t most_triangles = kMaxCadTriangles);

}  // namespace hl
