// Generated surfaces that are no meshes, y up, 0.2 m across.
#pragma once

#include <cstddef>
#include <memory>

#include "surfaces/height_field.h"

namespace hl {

/// The hills of makeTerrain() as a height field of about N triangles, of 16-bit samples: 1.1 bytes a triangle.
std::shared_ptr<const HeightField> makeTerrainField(std::size_t triangles);

}  // namespace hl
