// Welding: vertices that are the same in everything become one. Files without shared indices (STL; OBJ as assimp gives
// it) have three vertices for each triangle, which takes twice the memory of the mesh with its hierarchy.
#pragma once

#include <cstddef>

#include "scene/model.h"

namespace hl {

/// Joins vertices with the same bits of position, normal and texture coordinate. Elements keep their order and their
/// places, so they are touched with the same bits of force. Vertices keep the order of their first use in the list.
/// O(n); returns how many are gone. An index out of range stays out of range.
std::size_t weldVertices(Model& model);

}  // namespace hl
