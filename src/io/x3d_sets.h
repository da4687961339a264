// Sets of faces and lines of X3D (ISO/IEC 19775-1, 11 and 13), said as IndexedFaceSet and IndexedLineSet of which each
// face or line has an end of its own.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/x3d_document.h"

namespace hl {

/// The numbers of a text; commas are blanks.
std::vector<double> x3dNumbers(const std::string& text);

/// Whether it is a set that plainSet() rewrites.
bool isX3dSet(const std::string& type);

/// The fields of a set in other words. `points`: of its Coordinate. Returns its new type; empty: there is nothing in
/// it.
std::string plainSet(const std::string& type, X3dTree& set, std::size_t points, std::vector<std::string>& warnings);

/// As an IndexedFaceSet, the fields and the coordinates of a Cone: apex up. assimp's stands on it.
void makeCone(X3dTree& cone);

}  // namespace hl
