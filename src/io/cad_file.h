// CAD files, STEP, IGES and BREP: read by a program of its own, hl-cad, which has OpenCASCADE, as few need it and it is
// large. What it gives is kept (io/reading_cache.h), as it takes long.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "io/isolated.h"
#include "scene/scene_model.h"

namespace hl {

/// How curved surfaces become triangles.
struct CadMeshing {
  double deflection_m = 2e-6;  ///< distance between an edge of a triangle and its curve
  double angle_rad = 0.1;      ///< between neighbouring pieces of a curve
  bool asked = false;          ///< for this deflection; else it may be coarser, of what would take too long
  bool operator==(const CadMeshing&) const = default;
};

// What they may be: finer than light sees, coarser than any part.
inline constexpr double kMinDeflection_m = 1e-8, kMaxDeflection_m = 1e3, kMinAngle_rad = 0.01, kMaxAngle_rad = 1.5;

/// More triangles than these are refused, with a deflection that would do: some 2 GB where they are touched.
inline constexpr std::size_t kMaxCadTriangles = 20'000'000;

/// Of this ending: ".step", ".stp", ".iges", ".igs", ".brep".
bool readsCad(const std::string& ending);

/// The words after the name of hl-cad that make it read a file of this ending from its standard input; the rest of
/// them, read again. Throws hl::Error for words that are no such.
std::vector<std::string> wordsOf(const std::string& ending, const CadMeshing& meshing);
struct CadTask {
  std::string ending;
  CadMeshing meshing;
};
CadTask cadTaskOf(const std::vector<std::string>& words);

/// Reads what is open as `descriptor`, from its beginning. `name` stands before errors. Metres. Throws hl::Error if
/// hl-cad is not there, or the file cannot be used. May be called in a process with threads.
SceneModel readCad(int descriptor, const std::string& name, const CadTask& task, const IsolationLimits& limits,
                   const std::atomic<bool>& given_up, const std::function<void(double)>& progress);

}  // namespace hl
