// The triangles of a face, and the pieces of an edge without one, as parts of a model. Metres.
#pragma once

#include <BRepAdaptor_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <optional>

#include "io/cad_file.h"
#include "scene/model.h"

namespace hl {

/// Of a face that has a mesh. Returns the largest distance that was found between a triangle and the surface, m;
/// nothing for one without a mesh.
std::optional<double> appendFace(const TopoDS_Face& face, Model& model);

void appendEdge(const TopoDS_Edge& edge, const CadMeshing& meshing, Model& model);

}  // namespace hl
