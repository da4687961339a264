// Surfaces that make their primitives, of every kind and random form, each beside the same primitives as a mesh.
#pragma once

#include <memory>

#include "geometry/primitive_source.h"
#include "soak/random_scenes.h"

namespace hl::soak {

using Source = std::shared_ptr<const PrimitiveSource>;

/// What lies within a volume: closed, of one piece or many.
Source drawLump(test::Random& random);
/// The solid of an expression, within 0.1 mm at sizes of 10 mm: some thousand triangles, or many.
Source drawSolid(test::Random& random);
/// `shuffled` is the mesh.
RandomScene drawSurface(test::Random& random);

}  // namespace hl::soak
