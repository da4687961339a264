// CadShape: what is in a CAD file, in OpenCASCADE's terms. Millimetres, as OpenCASCADE has it.
#pragma once

#include <TopoDS_Shape.hxx>
#include <optional>
#include <string>
#include <vector>

#include "base/rgb.h"

namespace hl {

/// Metres of a unit of OpenCASCADE's shapes.
inline constexpr double kCadUnit_m = 1e-3;

/// A closed body of a file, where it is in the whole.
struct CadSolid {
  TopoDS_Shape shape;
  std::string name;
  std::optional<Rgb> colour{};  ///< absent: the file gives it none
};

struct CadShape {
  TopoDS_Shape shape;  ///< lengths in the file's units have become millimetres; those of BREP files are millimetres
  std::vector<CadSolid> solids{};  ///< of the shape; empty: they are not distinguished
  std::vector<std::string> warnings{};
};

}  // namespace hl
