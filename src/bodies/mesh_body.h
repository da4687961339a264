// Mesh body: the shape and the mass of a body by its mesh.
#pragma once

#include <cstddef>

#include "bodies/world.h"
#include "scene/body_spec.h"
#include "scene/model.h"

namespace hl {

/// As the spec says. Throws hl::Error, one line.
Body bodyOf(const Model& model, const BodySpec& spec);
/// The number of its parts, without making it where there is one. Throws as bodyOf().
std::size_t partsIn(const Model& model, const BodySpec& spec);

}  // namespace hl
