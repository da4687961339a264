// Surfaces that make their primitives, of every kind and random form, each beside the same primitives as a mesh.
#pragma once

#include "soak/random_scenes.h"

namespace hl::soak {

/// `shuffled` is the mesh.
RandomScene drawSurface(test::Random& random);

}  // namespace hl::soak
