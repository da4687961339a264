// CadShape: what is in a CAD file, in OpenCASCADE's terms. Millimetres, as OpenCASCADE has it.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

#include "io/model_file.h"

namespace hl {

/// Metres of a unit of OpenCASCADE's shapes.
inline constexpr double kCadUnit_m = 1e-3;

struct CadShape {
  TopoDS_Shape shape;  ///< lengths in the file's units have become millimetres; those of BREP files are millimetres
  std::vector<std::string> warnings{};
};

/// Opens no other file, and forbids that for good. Throws hl::Error for a file that cannot be used. `report` is told
/// how far it is, 0..1.
CadShape readCadShape(const ModelFile& file, const std::function<void(double)>& report);

}  // namespace hl
