// Welding: joins identical vertices. Files without shared indices (STL; OBJ as assimp returns it) have three vertices
// per triangle, which takes twice the memory of the mesh with its hierarchy.
#pragma once

#include <cstddef>

#include "scene/model.h"

namespace hl {

/// Joins vertices with the same bits of position, normal and texture coordinate. Elements keep their order and
/// positions, so the forces are the same bit by bit. Vertices keep the order of their first use in the list, and of
/// several colours the first. O(n).
/// Returns the number of vertices removed. An index out of range stays out of range.
std::size_t weldVertices(Model& model);

}  // namespace hl
