// Random triangles that fill a box, without surface, order or neighbours.
#pragma once

#include <cstddef>

#include "scene/model.h"

namespace hl {

/// `triangles` equilateral triangles with random orientations in a box of 0.2 m, y up. Their edge is the mean distance
/// of their centres, so the soup looks the same for every number. The same number gives the same soup.
Model makeSoup(std::size_t triangles);

}  // namespace hl
