// Solids that are written down: examples of implicit surfaces.
#pragma once

#include <string>

#include "scene/scene_model.h"

namespace hl {

inline constexpr const char* kSdfNames = "sdf:torus, sdf:gyroid, sdf:blend, sdf:spheres, sdf:bracket";

/// About 80 mm wide, within 10 um. Torus: of 30 mm with a tube of 10 mm. Gyroid: walls of 2 mm, in a ball. Blend: three
/// bodies that flow into each other. Spheres: two, 0.1 mm apart. Bracket: a plate with holes and a rib, with sharp
/// edges. Throws hl::Error for another name.
SceneModel makeSdf(const std::string& spec);

}  // namespace hl
