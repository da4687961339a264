// Random triangles that fill a box: what has no surface, no order and no neighbours.
#pragma once

#include <cstddef>

#include "scene/model.h"

namespace hl {

/// `triangles` equilateral ones in a box of 0.2 m, y up, each turned at random. Their edge is the mean distance between
/// their centres, so the soup looks the same whatever their number. The same number gives the same soup.
Model makeSoup(std::size_t triangles);

}  // namespace hl
