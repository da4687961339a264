// CadDocument: the parts of an assembly with the names and colours that a STEP or IGES file gives them (OpenCASCADE's
// XCAF).
#pragma once

#include <TDocStd_Document.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

#include "cad/cad_shape.h"

namespace hl {

/// An empty one, into which a reader transfers a file.
Handle(TDocStd_Document) newCadDocument();

/// All of it as one shape; null if there is none.
TopoDS_Shape wholeShape(const Handle(TDocStd_Document) & document);

/// Each solid, wherever it is placed. Its name is that of its part, with a number from the second of the same name on;
/// its colour is what counts in the assembly, or else that of most of its faces.
std::vector<CadSolid> solidsIn(const Handle(TDocStd_Document) & document);

/// Those of a shape without names and colours: "solid", "solid 2" ...
std::vector<CadSolid> solidsIn(const TopoDS_Shape& shape);

}  // namespace hl
